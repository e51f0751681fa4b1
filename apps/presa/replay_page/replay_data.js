'use strict';
// The recording as the page holds it (packed.h has the form), one time for all parts, and who wants to know of it.
const presaReplay = (() => {
  const data = JSON.parse(document.getElementById('replay-data').textContent);

  const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const numbers = (channel, count) => {
    if (!('d' in channel)) return new Float32Array(count).fill(channel.lo);
    const levels = new Int16Array(bytes(channel.d).buffer);
    return Float32Array.from(levels, level => level === -32768 ? NaN : channel.lo + channel.step * (level + 32767));
  };

  const {signals} = data;
  for (const panel of signals.panels) {
    for (const curve of panel.curves) {
      curve.low = numbers(curve.low, signals.count);
      // each is rounded by itself: where they are almost equal, low may come out above high
      const high = curve.high ? numbers(curve.high, signals.count) : curve.low;
      curve.high = high.map((value, i) => Math.max(value, curve.low[i]));
    }
  }
  for (const state of signals.states) state.seen = bytes(state.seen);

  const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
  const binAt = time => clamp(Math.floor((time - signals.begin) / signals.width + 1e-6), 0, signals.count - 1);
  // of the states in a bin the rarest to see: slip, then stick
  const stateOf = seen => seen & 4 ? 'slip' : seen & 2 ? 'stick' : 'free';

  const listeners = [];
  const length = Math.max(data.end - data.begin, 1e-3);
  const clock = {
    time: data.begin, from: data.begin, to: data.begin + length, playing: false,
    shown: data.begin,  // the time that the pointer is on, else `time`
  };
  // what: 'time' or 'zoom'
  const tell = what => { for (const listener of listeners) listener(what); };

  const replay = {
    data, numbers, bytes, clamp, binAt, stateOf, clock, length, tell,
    listen: listener => listeners.push(listener),
    go(time) {
      clock.time = clock.shown = clamp(time, data.begin, data.end);
      const span = clock.to - clock.from;  // the plots go with it
      if (clock.time < clock.from || clock.time > clock.to) replay.zoom(clock.time - 0.1 * span, clock.time + 0.9 * span);
      tell('time');
    },
    /** Shows a time as long as the pointer is on it; none: back to the time that was set. */
    peek(time) {
      clock.shown = time === undefined ? clock.time : clamp(time, data.begin, data.end);
      tell('time');
    },
    zoom(from, to) {
      const span = clamp(to - from, Math.min(length, Math.max(signals.width * 10, 0.01)), length);
      clock.from = clamp((from + to - span) / 2, data.begin, data.begin + length - span);
      clock.to = clock.from + span;
      tell('zoom');
    },
    zoomBy(factor, around) {
      replay.zoom(around - (around - clock.from) * factor, around + (clock.to - around) * factor);
    },
    phaseAt: time => data.phases.find(phase => phase.begin <= time && time < phase.end),
  };
  return replay;
})();
