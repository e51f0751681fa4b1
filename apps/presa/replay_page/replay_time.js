'use strict';
// Play, scrub, zoom: mouse, touch and keys.
(() => {
  const {data, clock, clamp, plots, paper} = presaReplay, {signals} = data;
  const root = document.getElementById('replay'), area = plots.plots;
  const scrubber = document.getElementById('replay-scrubber'), play = root.querySelector('[data-do=play]');
  const speed = root.querySelector('.replay-speed select'), track = root.querySelector('.replay-track canvas');
  const now = name => root.querySelector(`[data-now=${name}]`);
  const still = matchMedia('(prefers-reduced-motion: reduce)');
  root.hidden = false;

  // ---- figures ----

  const text = seconds => seconds.toFixed(3) + ' s';
  const fingers = signals.states.map(state => {
    const line = document.createElement('li');
    now('fingers').append(line);
    return {state, line};
  });
  function showTime() {
    const time = clock.shown, phase = presaReplay.phaseAt(time);
    now('time').textContent = text(time);
    now('phase').textContent = phase ? phase.name : '';
    now('clock').firstChild.textContent = text(clock.time);
    for (const {state, line} of fingers) {
      line.className = plots.stateAt(state, time);
      line.textContent = state.name + ': ' + line.className;
    }
    scrubber.value = clock.time;
    scrubber.setAttribute('aria-valuetext', text(clock.time) + (phase ? ', ' + phase.name : ''));
  }
  function drawTrack() {
    const ratio = window.devicePixelRatio || 1, w = track.clientWidth, h = track.clientHeight;
    if (!w) return;
    const pen = track.getContext('2d');
    track.width = w * ratio;
    track.height = h * ratio;
    pen.scale(ratio, ratio);
    const xOf = time => 7 + (time - data.begin) / presaReplay.length * (w - 14);  // half a thumb on each side
    pen.fillStyle = paper.theme('--rule');
    pen.beginPath(), pen.rect(7, h / 2 - 3, w - 14, 6), pen.fill();
    for (let i = 0; i < data.phases.length; ++i) {
      pen.fillStyle = paper.theme(i % 2 ? '--rule' : '--soft');
      pen.globalAlpha = i % 2 ? 1 : 0.6;
      pen.fillRect(xOf(data.phases[i].begin), h / 2 - 3, xOf(data.phases[i].end) - xOf(data.phases[i].begin), 6);
    }
    pen.globalAlpha = 1;
    pen.fillStyle = paper.theme('--bad');
    for (const fault of data.faults) pen.fillRect(xOf(fault.time) - 1.5, h / 2 - 11, 3, 22);
    if (clock.to - clock.from < presaReplay.length * 0.9999) {  // what the plots show
      pen.strokeStyle = paper.theme('--stick');
      pen.lineWidth = 1.5;
      pen.strokeRect(xOf(clock.from), h / 2 - 8, Math.max(2, xOf(clock.to) - xOf(clock.from)), 16);
    }
  }
  presaReplay.listen(what => what === 'time' ? showTime() : drawTrack());

  // ---- play ----

  let before = 0, drawn = 0;
  function advance(stamp) {
    if (!clock.playing) return;
    const seconds = before ? (stamp - before) / 1000 : 0;
    if (!before) drawn = stamp;
    // whoever wants little motion sees four pictures a second
    if (before && still.matches && stamp - drawn < 250) return void requestAnimationFrame(advance);
    const passed = still.matches ? (stamp - drawn) / 1000 : seconds;
    before = drawn = stamp;
    const next = clock.time + passed * Number(speed.value);
    presaReplay.go(next);
    if (next >= data.end) setPlaying(false);
    if (clock.playing) requestAnimationFrame(advance);
  }
  function setPlaying(playing) {
    if (playing && clock.time >= data.end - 1e-6) presaReplay.go(data.begin);
    clock.playing = playing;
    play.classList.toggle('playing', playing);
    play.setAttribute('aria-label', playing ? 'Pause' : 'Play');
    play.title = (playing ? 'Pause' : 'Play') + ' (space)';
    before = 0;
    if (playing) requestAnimationFrame(advance);
  }
  const marks = [...data.phases.map(phase => phase.begin), ...data.faults.map(fault => fault.time), data.end];
  marks.sort((a, b) => a - b);
  const actions = {
    play: () => setPlaying(!clock.playing),
    before: () => presaReplay.go(marks.filter(time => time < clock.time - 1e-3).pop() ?? data.begin),
    after: () => presaReplay.go(marks.find(time => time > clock.time + 1e-3) ?? data.end),
    in: () => presaReplay.zoomBy(0.5, clamp(clock.time, clock.from, clock.to)),
    out: () => presaReplay.zoomBy(2, clamp(clock.time, clock.from, clock.to)),
    all: () => presaReplay.zoom(data.begin, data.begin + presaReplay.length),
  };
  for (const button of root.querySelectorAll('[data-do]')) {
    if (actions[button.dataset.do]) button.addEventListener('click', actions[button.dataset.do]);
  }
  now('clock').lastChild.textContent = ' / ' + text(data.end);
  scrubber.min = data.begin;
  scrubber.max = data.end;
  scrubber.addEventListener('input', () => { setPlaying(false); presaReplay.go(Number(scrubber.value)); });
  const keys = {' ': 'play', '[': 'before', ']': 'after', '+': 'in', '=': 'in', '-': 'out', '0': 'all'};
  addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (root.getBoundingClientRect().bottom < 0) return;  // out of sight, further up: the page scrolls
    const {target, key} = event, name = target === scrubber ? '' : target.tagName;
    if (name === 'SELECT' || (key === ' ' && ['INPUT', 'BUTTON', 'SUMMARY', 'A'].includes(name))) return;
    const step = (event.shiftKey ? 0.1 : 0.01) * ({ArrowLeft: -1, ArrowRight: 1}[key] || 0);
    if (step) { setPlaying(false); presaReplay.go(clock.time + step); }
    else if (key === 'Home' && target === scrubber) presaReplay.go(data.begin);
    else if (key === 'End' && target === scrubber) presaReplay.go(data.end);
    else if (keys[key]) actions[keys[key]]();
    else return;
    event.preventDefault();
  });

  // ---- mouse and touch in the plots ----

  const fingersDown = new Map();  // pointer: x
  let grip = null;                // of two fingers: their times
  const timeAt = event => clamp(paper.timeOf(plots.xInside(event)), clock.from, clock.to);
  area.addEventListener('pointerdown', event => {
    if (event.button !== 0) return;
    fingersDown.set(event.pointerId, plots.xInside(event));
    area.setPointerCapture(event.pointerId);
    if (fingersDown.size === 2) grip = [...fingersDown.values()].map(paper.timeOf);
    if (fingersDown.size > 1) return;
    setPlaying(false);
    presaReplay.go(timeAt(event));
  });
  area.addEventListener('pointermove', event => {
    if (fingersDown.size === 0) {
      if (event.pointerType === 'mouse' && !clock.playing) presaReplay.peek(timeAt(event));
      return;
    }
    if (!fingersDown.has(event.pointerId)) return;
    fingersDown.set(event.pointerId, plots.xInside(event));
    if (fingersDown.size === 1) return grip ? undefined : presaReplay.go(timeAt(event));
    if (fingersDown.size === 2) {  // the times under both fingers stay there
      const [a, b] = [...fingersDown.values()], span = clock.to - clock.from;
      const pixel = paper.timeOf(a + 1) - paper.timeOf(a);
      if (Math.abs(a - b) < 10) return;
      const scale = Math.abs(grip[1] - grip[0]) / (Math.abs(a - b) * pixel);
      const from = grip[0] - (paper.timeOf(a) - clock.from) * scale;
      presaReplay.zoom(from, from + span * scale);
    }
  });
  const release = event => {
    fingersDown.delete(event.pointerId);
    if (fingersDown.size === 0) grip = null;
  };
  area.addEventListener('pointerup', release);
  area.addEventListener('pointercancel', release);
  area.addEventListener('pointerleave', () => { if (fingersDown.size === 0 && !clock.playing) presaReplay.peek(); });
  area.addEventListener('wheel', event => {
    const span = clock.to - clock.from, pans = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
    if (!pans && event.deltaY > 0 && span >= presaReplay.length * 0.9999) return;  // all is shown: the page scrolls
    event.preventDefault();
    if (pans) {
      const by = span * 0.0015 * (Math.abs(event.deltaX) > Math.abs(event.deltaY) ? event.deltaX : event.deltaY);
      presaReplay.zoom(clock.from + by, clock.to + by);
    } else {
      presaReplay.zoomBy(Math.exp(clamp(event.deltaY, -200, 200) * 0.002), timeAt(event));
    }
  }, {passive: false});
  area.addEventListener('dblclick', actions.all);

  // ---- start ----

  now('decimation').textContent = data.decimation;
  new ResizeObserver(drawTrack).observe(track);
  function fromAddress() {
    const time = /[#&]t=([-+.\deE]+)/.exec(location.hash);
    const zoom = /[#&]zoom=([-+.\deE]+),([-+.\deE]+)/.exec(location.hash);
    if (zoom) presaReplay.zoom(Number(zoom[1]), Number(zoom[2]));
    presaReplay.go(time && Number.isFinite(Number(time[1])) ? Number(time[1]) : clock.time);
  }
  addEventListener('hashchange', fromAddress);
  fromAddress();
  plots.redraw();
  drawTrack();
  if (presaReplay.scene) presaReplay.scene.resize();
})();
