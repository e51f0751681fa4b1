'use strict';
// The plots under one time axis. Curves are drawn once for each zoom; the time is a line on top of them.
presaReplay.plots = (() => {
  const {data, clock, binAt, stateOf, clamp, paper} = presaReplay, {signals} = data;
  const {plots, theme, xOf, timeOf} = paper, cursor = plots.querySelector('.replay-cursor');
  const kColors = ['--s1', '--s3', '--s0', '--s2', '--s4', '--s5', '--ink', '--s4', '--s2', '--s0', '--s5'];
  const make = (tag, className, text) => {
    const element = document.createElement(tag);
    if (className) element.className = className;
    if (text) element.textContent = text;
    return element;
  };

  // ---- drawing ----

  /** Min and max of a curve in each pixel column, or in each bin where those are wider. */
  function columns(curve) {
    const first = binAt(clock.from), past = binAt(clock.to) + 1, out = [];
    const stride = Math.max(1, Math.floor((past - first) / (paper.right() - paper.left())));
    const middle = signals.every_tick && stride === 1 ? 0 : stride / 2;  // a tick is at the beginning of its bin
    for (let bin = Math.max(0, first - 1); bin < Math.min(signals.count, past + 1); bin += stride) {
      let low = Infinity, high = -Infinity;
      for (let i = bin; i < Math.min(bin + stride, signals.count); ++i) {
        if (curve.low[i] < low) low = curve.low[i];
        if (curve.high[i] > high) high = curve.high[i];
      }
      out.push({x: xOf(signals.begin + (bin + middle) * signals.width), low, high});
    }
    return out;
  }
  function strokeCurve(pen, run, yOf, thick) {
    pen.beginPath();
    run.forEach((p, i) => i ? pen.lineTo(p.x, yOf(p.high)) : pen.moveTo(p.x, yOf(p.high)));
    if (thick) {  // the area between min and max
      for (let i = run.length - 1; i >= 0; --i) pen.lineTo(run[i].x, yOf(run[i].low));
      pen.closePath();
      pen.fill();
    }
    pen.stroke();
  }
  function curveLines(pen, curve, order, yOf) {
    const limit = curve.style === 'limit';
    pen.strokeStyle = pen.fillStyle = theme(kColors[curve.color]);
    // where curves coincide, the wider one behind stays in sight
    pen.lineWidth = limit ? 1.3 : Math.max(1.3, 3.4 - 1.6 * order);
    pen.globalAlpha = limit ? 0.75 : 1;
    pen.setLineDash(limit ? [5, 4] : []);
    pen.lineJoin = 'round';
    let run = [];
    const flush = () => {
      if (run.length === 1) run.push({...run[0], x: run[0].x + 1});  // a bin between gaps
      if (run.length) strokeCurve(pen, run, yOf, !limit && run.some(p => p.high > p.low));
      run = [];
    };
    for (const point of columns(curve)) point.low <= point.high ? run.push(point) : flush();
    flush();
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  }
  function rangeOf(curves) {
    let low = Infinity, high = -Infinity;
    for (const curve of curves) {
      for (let i = binAt(clock.from); i <= binAt(clock.to); ++i) {
        if (curve.low[i] < low) low = curve.low[i];
        if (curve.high[i] > high) high = curve.high[i];
      }
    }
    return low <= high ? [low, high] : [0, 1];
  }
  function drawPanel(panel) {
    const page = paper.sheet(panel.canvas), {pen, h} = page, left = paper.left(), right = paper.right();
    paper.background(page);
    let [low, high] = rangeOf(panel.curves);
    if (panel.unit === 'N') low = Math.min(low, 0);
    if (panel.unit === 'N' && high - low < 1e-6) high = low + 1;
    const room = Math.max((high - low) * 0.06, panel.unit === 'N' ? 0 : 0.5);
    if (low !== 0) low -= room;
    high += room;
    const yOf = value => h - 4 - (value - low) / (high - low) * (h - 8);
    const marks = paper.ticks(low, high, Math.max(2, h / 34));
    pen.textAlign = 'right';
    pen.textBaseline = 'middle';
    for (const mark of marks.all) {
      const y = yOf(mark);
      pen.fillStyle = theme('--grid');
      pen.fillRect(left, Math.round(y), right - left, 1);
      pen.fillStyle = theme('--soft');
      pen.fillText(mark.toFixed(marks.decimals), left - 6, clamp(y, 7, h - 7));
    }
    pen.save();
    pen.beginPath(), pen.rect(left, 0, right - left, h), pen.clip();
    let order = 0;
    for (const curve of panel.curves) curveLines(pen, curve, curve.style === 'limit' ? order - 1 : order++, yOf);
    paper.faultLines(page);
    pen.restore();
  }
  function seenBetween(state, from, to) {
    let seen = 0;
    for (let i = binAt(from), last = Math.max(i, binAt(to) - 1); i <= last; ++i) seen |= state.seen[i];
    return seen;
  }
  function drawStates(panel) {
    const page = paper.sheet(panel.canvas), {pen} = page, left = paper.left(), right = paper.right(), row = 17;
    signals.states.forEach((state, line) => {
      pen.fillStyle = theme('--soft');
      pen.textAlign = 'right';
      pen.textBaseline = 'middle';
      pen.fillText(state.name, left - 6, line * row + 8, left - 10);
      let from = left, before = null;
      for (let x = left; x <= right; ++x) {
        const now = x < right ? stateOf(seenBetween(state, timeOf(x), timeOf(x + 1))) : null;
        if (now === before) continue;
        if (before) {
          pen.fillStyle = theme('--' + before);
          pen.globalAlpha = before === 'free' ? 0.25 : 1;
          pen.fillRect(from, line * row + 2, Math.max(1, x - from), row - 5);
          pen.globalAlpha = 1;
        }
        from = x;
        before = now;
      }
    });
    paper.faultLines(page);
  }
  // ---- panels ----

  const panels = [];
  function addPanel(title, draw, more = {}) {
    const element = make('div', 'replay-panel' + (more.height ? ' fixed' : ''));
    const box = make('div', 'box'), canvas = make('canvas');
    if (title) {
      const head = make('header');
      head.append(make('b', '', title));
      element.dataset.title = title;
      element.append(head);
      if (more.note) head.append(make('em', '', more.note));
      canvas.setAttribute('role', 'img');
      canvas.setAttribute('aria-label', title + ' over time');
      more.head = head;
    }
    if (more.height) box.style.height = more.height + 'px';
    box.append(canvas);
    element.append(box);
    plots.append(element);
    panels.push({canvas, draw, ...more});
    return panels[panels.length - 1];
  }
  const legends = [];  // [element of the value, what it shows at a time]
  function legend(head, name, color, valueAt) {
    const label = make('span'), value = make('span', 'value'), line = make('i');
    if (color) line.style.borderColor = `var(${color})`;
    value.dataset.name = name;
    label.append(...(color ? [line] : []), name ? name + ' ' : '', value);
    head.append(label);
    legends.push([value, valueAt]);
  }
  function valueOf(curve, unit, limit) {
    const digits = unit === 'N' ? 2 : 1;
    const text = ({low, high}, bin) => {
      if (!(low[bin] <= high[bin])) return '\u2013';
      const [a, b] = [low[bin].toFixed(digits), high[bin].toFixed(digits)];
      return a === b ? a : a + '\u2026' + b;
    };
    return time => text(curve, binAt(time)) + (limit ? ' of ' + text(limit, binAt(time)) : '') + ' ' + unit;
  }
  const strip = (data.phases.length ? 18 : 0) + (data.faults.length ? 17 : 0);
  if (strip) addPanel('', panel => paper.drawPhases(panel.canvas), {height: strip});
  for (const {title, unit, note, curves} of signals.panels) {
    const panel = addPanel(`${title} [${unit}]`, drawPanel, {unit, curves});
    for (const curve of curves) {
      if (curve.style === 'limit') continue;
      const limit = curves.find(other => other.style === 'limit' && other.color === curve.color);
      const named = curves.length > 1 || curve.name.toLowerCase() !== title.toLowerCase();
      legend(panel.head, named ? curve.name : '', kColors[curve.color], valueOf(curve, unit, limit));
    }
    if (note) panel.head.append(make('em', '', note));
  }
  const stateAt = (state, time) => stateOf(state.seen[binAt(time)]);
  if (signals.states.length) {
    const panel = addPanel('Contact', drawStates, {height: signals.states.length * 17 + 2});
    for (const state of signals.states) legend(panel.head, state.name, '', time => stateAt(state, time));
  }
  addPanel('', panel => paper.drawAxis(panel.canvas), {height: 22});

  function redraw() {
    if (!paper.measure()) return;
    for (const panel of panels) panel.draw(panel);
    moveCursor();
  }
  function moveCursor() {
    const x = xOf(clock.shown);
    cursor.style.transform = `translateX(${x - 0.75}px)`;
    cursor.style.visibility = x < paper.left() - 1 || x > paper.right() + 1 ? 'hidden' : 'visible';
    for (const [value, valueAt] of legends) value.textContent = valueAt(clock.shown);
  }
  let waiting = false;
  presaReplay.listen(what => {
    if (what === 'time') return moveCursor();
    if (!waiting) { waiting = true; requestAnimationFrame(() => { waiting = false; redraw(); }); }
  });
  paper.readTheme();
  new ResizeObserver(() => { paper.readTheme(); redraw(); }).observe(plots);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    paper.readTheme();
    redraw();
    presaReplay.tell('zoom');
  });

  return {
    plots, stateAt, redraw,
    xInside: event => event.clientX - plots.getBoundingClientRect().left,
  };
})();
