'use strict';
// What the plots are drawn on: their time axis, background, phases and faults.
presaReplay.paper = (() => {
  const {data, clock, clamp} = presaReplay;
  const root = document.getElementById('replay'), plots = root.querySelector('.replay-plots'), kRight = 12;
  let theme = {}, gutter = 56, width = 0;
  const readTheme = () => {
    const css = getComputedStyle(root);
    theme = name => css.getPropertyValue(name).trim();
    gutter = parseFloat(theme('--gutter'));
  };
  const xOf = time => gutter + (time - clock.from) / (clock.to - clock.from) * (width - gutter - kRight);
  const timeOf = x => clock.from + (x - gutter) / (width - gutter - kRight) * (clock.to - clock.from);

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
  /** The text, cut where it is too wide; nothing where not even two letters fit. */
  function fitting(pen, text, room) {
    if (pen.measureText(text).width <= room) return text;
    let cut = text;
    while (cut && pen.measureText(cut + '\u2026').width > room) cut = cut.slice(0, -1);
    return cut.length > 1 ? cut + '\u2026' : '';
  }
  function drawPhases(canvas) {
    const page = sheet(canvas), {pen} = page;
    background(page);
    pen.textBaseline = 'middle';
    pen.textAlign = 'center';
    pen.font = '600 ' + pen.font;
    pen.fillStyle = theme('--soft');
    for (const phase of data.phases.filter(shown)) {
      const from = Math.max(gutter, xOf(phase.begin)), to = Math.min(width - kRight, xOf(phase.end));
      pen.fillText(fitting(pen, phase.name, to - from - 4), (from + to) / 2, 9);
    }
    faultLines(page);
    pen.fillStyle = theme('--bad');
    let free = 0;
    for (const fault of data.faults) {
      const x = xOf(fault.time), long = pen.measureText(fault.text).width;
      if (x < gutter || x > width - kRight || x < free) continue;
      const left = x + long + 8 > width - kRight;  // then its text is on the left of the line
      pen.textAlign = left ? 'right' : 'left';
      const text = left ? fitting(pen, fault.text, x - gutter - 8) : fault.text;
      pen.fillText(text, left ? x - 5 : x + 5, data.phases.length ? 26 : 9);
      free = left ? Infinity : x + long + 12;
    }
  }
  function drawAxis(canvas) {
    const {pen, w} = sheet(canvas), marks = ticks(clock.from, clock.to, Math.max(3, (w - gutter) / 90));
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

  return {
    plots, readTheme, sheet, ticks, background, faultLines, drawPhases, drawAxis, xOf, timeOf,
    theme: name => theme(name),
    /** Reads how wide the plots are now. */
    measure: () => width = plots.clientWidth,
    left: () => gutter,
    right: () => width - kRight,
  };
})();
