'use strict';
// The plots under one time axis. Curves are drawn once for each zoom; the time is a line on top of them.
presaReplay.plots = (() => {
  const {data, clock, binAt, stateOf, clamp} = presaReplay, {signals} = data;
  const root = document.getElementById('replay'), plots = root.querySelector('.replay-plots'), cursor = plots.querySelector('.replay-cursor');
  const kRight = 12, kStates = ['slip', 'stick', 'free'];
  const kColors = ['--s1', '--s3', '--s0', '--s2', '--s4', '--s5', '--ink', '--s4', '--s2', '--s0', '--s5'];
  let theme = {}, gutter = 56, width = 0;
  const readTheme = () => {
    const css = getComputedStyle(root);
    theme = name => css.getPropertyValue(name).trim();
    gutter = parseFloat(theme('--gutter'));
  };
  const xOf = time => gutter + (time - clock.from) / (clock.to - clock.from) * (width - gutter - kRight);
  const timeOf = x => clock.from + (x - gutter) / (width - gutter - kRight) * (clock.to - clock.from);
  const make = (tag, className, text) => {
    const element = document.createElement(tag);
    if (className) element.className = className;
    if (text) element.textContent = text;
    return element;
  };

  // ---- drawing ----

  function sheet(canvas) {
    const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
    const pen = canvas.getContext('2d');
    pen.scale(ratio, ratio);
    pen.font = '11.5px system-ui, "Liberation Sans", sans-serif';
    return {pen, w, h};
  }
  function ticks(low, high, target) {
    const raw = (high - low) / target, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find(m => m * power >= raw * 0.999), all = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) all.push(i * step);
    return {all, decimals: Math.max(0, -Math.floor(Math.log10(step) + 1e-9))};
  }
  const shown = item => item.end > clock.from && item.begin < clock.to;
  function background({pen, h}) {
    data.phases.forEach((phase, i) => {
      if (i % 2 || !shown(phase)) return;
      const from = Math.max(gutter, xOf(phase.begin)), to = Math.min(width - kRight, xOf(phase.end));
      pen.fillStyle = theme('--soft');
      pen.globalAlpha = 0.07;
      pen.fillRect(from, 0, to - from, h);
      pen.globalAlpha = 1;
    });
  }
  function faultLines({pen, h}) {
    pen.strokeStyle = theme('--bad');
    pen.lineWidth = 1.5;
    for (const fault of data.faults) {
      const x = xOf(fault.time);
      if (x < gutter || x > width - kRight) continue;
      pen.beginPath(), pen.moveTo(x, 0), pen.lineTo(x, h), pen.stroke();
    }
  }
  /** Min and max of a curve in each pixel column, or in each bin where those are wider. */
  function columns(curve) {
    const first = binAt(clock.from), past = binAt(clock.to) + 1, each = (past - first) / (width - gutter - kRight), out = [];
    const stride = Math.max(1, Math.floor(each));
    for (let bin = Math.max(0, first - 1); bin < Math.min(signals.count, past + 1); bin += stride) {
      let low = Infinity, high = -Infinity;
      for (let i = bin; i < Math.min(bin + stride, signals.count); ++i) {
        if (curve.low[i] < low) low = curve.low[i];
        if (curve.high[i] > high) high = curve.high[i];
      }
      out.push({x: xOf(signals.begin + (bin + (signals.every_tick && stride === 1 ? 0 : stride / 2)) * signals.width), low, high});
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
    const page = sheet(panel.canvas), {pen, w, h} = page;
    background(page);
    let [low, high] = rangeOf(panel.curves);
    if (panel.unit === 'N') low = Math.min(low, 0);
    if (panel.unit === 'N' && high - low < 1e-6) high = low + 1;
    const room = Math.max((high - low) * 0.06, panel.unit === 'N' ? 0 : 0.5);
    if (low !== 0) low -= room;
    high += room;
    const yOf = value => h - 4 - (value - low) / (high - low) * (h - 8);
    const marks = ticks(low, high, Math.max(2, h / 34));
    pen.textAlign = 'right';
    pen.textBaseline = 'middle';
    for (const mark of marks.all) {
      const y = yOf(mark);
      pen.fillStyle = theme('--grid');
      pen.fillRect(gutter, Math.round(y), w - gutter - kRight, 1);
      pen.fillStyle = theme('--soft');
      pen.fillText(mark.toFixed(marks.decimals), gutter - 6, clamp(y, 7, h - 7));
    }
    pen.save();
    pen.beginPath(), pen.rect(gutter, 0, w - gutter - kRight, h), pen.clip();
    let order = 0;
    for (const curve of panel.curves) curveLines(pen, curve, curve.style === 'limit' ? order - 1 : order++, yOf);
    faultLines(page);
    pen.restore();
  }
  function drawStates(panel) {
    const page = sheet(panel.canvas), {pen, w} = page;
    const row = 17, right = w - kRight;
    signals.states.forEach((state, line) => {
      pen.fillStyle = theme('--soft');
      pen.textAlign = 'right';
      pen.textBaseline = 'middle';
      pen.fillText(state.name, gutter - 6, line * row + 8, gutter - 10);
      let from = gutter, before = null;
      for (let x = gutter; x <= right; ++x) {
        let seen = 0;
        if (x < right) for (let i = binAt(timeOf(x)), last = Math.max(i, binAt(timeOf(x + 1)) - 1); i <= last; ++i) seen |= state.seen[i];
        const now = x < right ? stateOf(seen) : null;
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
    faultLines(page);
  }
  function drawPhases(panel) {
    const page = sheet(panel.canvas), {pen} = page;
    background(page);
    pen.textBaseline = 'middle';
    pen.textAlign = 'center';
    pen.font = '600 ' + pen.font;
    pen.fillStyle = theme('--soft');
    for (const phase of data.phases.filter(shown)) {
      const from = Math.max(gutter, xOf(phase.begin)), to = Math.min(width - kRight, xOf(phase.end));
      let name = phase.name;
      while (name && pen.measureText(name).width > to - from - 4) name = name.slice(0, -1);
      if (name.length > 2 || name === phase.name) pen.fillText(name.length < phase.name.length ? name.slice(0, -1) + '\u2026' : name, (from + to) / 2, 9);
    }
    faultLines(page);
    pen.fillStyle = theme('--bad');
    let free = 0;
    for (const fault of data.faults) {
      const x = xOf(fault.time), text = fault.text.split(';')[0], long = pen.measureText(text).width;
      if (x < gutter || x > width - kRight || x < free) continue;
      const left = x + long + 8 > width - kRight;
      pen.textAlign = left ? 'right' : 'left';
      pen.fillText(text, left ? x - 5 : x + 5, data.phases.length ? 26 : 9, left ? x - gutter - 6 : undefined);
      free = left ? Infinity : x + long + 12;
    }
  }
  function drawAxis(panel) {
    const {pen, w} = sheet(panel.canvas), marks = ticks(clock.from, clock.to, Math.max(3, (w - gutter) / 90));
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    pen.fillStyle = theme('--soft');
    for (const mark of marks.all) {
      pen.fillRect(Math.round(xOf(mark)), 0, 1, 4);
      pen.fillText(mark.toFixed(marks.decimals), clamp(xOf(mark), gutter, w - 20), 12);
    }
    pen.textAlign = 'right';
    pen.fillText('t [s]', gutter - 13, 12);
  }

  // ---- panels ----

  const panels = [];
  function addPanel(title, draw, more = {}) {
    const element = make('div', 'replay-panel' + (more.height ? ' fixed' : '')), box = make('div', 'box'), canvas = make('canvas');
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
  if (strip) addPanel('', drawPhases, {height: strip});
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
  addPanel('', drawAxis, {height: 22});

  function redraw() {
    width = plots.clientWidth;
    if (!width) return;
    for (const panel of panels) panel.draw(panel);
    moveCursor();
  }
  function moveCursor() {
    const x = xOf(clock.shown);
    cursor.style.transform = `translateX(${x - 0.75}px)`;
    cursor.style.visibility = x < gutter - 1 || x > width - kRight + 1 ? 'hidden' : 'visible';
    for (const [value, valueAt] of legends) value.textContent = valueAt(clock.shown);
  }
  let waiting = false;
  presaReplay.listen(what => {
    if (what === 'time') return moveCursor();
    if (!waiting) { waiting = true; requestAnimationFrame(() => { waiting = false; redraw(); }); }
  });
  readTheme();
  new ResizeObserver(() => { readTheme(); redraw(); }).observe(plots);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { readTheme(); redraw(); presaReplay.tell('zoom'); });

  return {plots, timeOf, stateAt, redraw, theme: name => theme(name), states: kStates, xInside: event => event.clientX - plots.getBoundingClientRect().left};
})();
