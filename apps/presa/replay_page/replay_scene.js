'use strict';
// The bodies in 3-D. Nothing here runs where there is no WebGL or no scene.
presaReplay.scene = (() => {
  const {data, numbers, clock, clamp} = presaReplay;
  const view = document.querySelector('.replay-view'), canvas = view.querySelector('.replay-canvas');
  const refuse = why => {
    canvas.remove();
    for (const part of view.querySelectorAll('.replay-tools, .replay-key')) part.remove();
    const line = view.querySelector('.replay-trouble');
    line.textContent = why;
    line.hidden = false;
    return null;
  };
  if (!data.scene)
    return refuse(`No 3-D view: this recording's scene cannot be loaded here (${data.trouble}). The plots are whole.`);
  const trial = document.createElement('canvas');
  if (!(trial.getContext('webgl2') || trial.getContext('webgl')))
    return refuse('No 3-D view: this browser has no WebGL, or it is switched off. The plots are whole.');

  const renderer = new THREE.WebGLRenderer({canvas, antialias: true});
  renderer.gammaOutput = true;  // colours of materials are linear
  renderer.gammaFactor = 2.2;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(32, 1, 0.001, 100);
  camera.up.set(0, 0, 1);

  // ---- bodies ----

  const shapes = presaReplay.shapes();
  function place(object, pose) {
    object.position.set(pose[0], pose[1], pose[2]);
    object.quaternion.set(pose[4], pose[5], pose[6], pose[3]);
  }
  function groupOf(list, color, casts) {
    const group = new THREE.Group();
    for (const shape of list) {
      const mesh = new THREE.Mesh(shapes.geometryOf(shape), shapes.materialOf(shape.color || color));
      mesh.castShadow = casts;
      mesh.receiveShadow = true;
      place(mesh, shape.pose);
      group.add(mesh);
    }
    return group;
  }
  const bodies = data.scene.bodies.map(body => {
    const group = groupOf(body.shapes, body.color, true);
    place(group, body.pose);
    scene.add(group);
    return group;
  });

  // the sun's shadows end near the bodies and would cut those of devices off
  const devices = new THREE.Group(), parts = data.scene.parts.map(part => groupOf(part.shapes, null, false));
  if (parts.length) {
    devices.add(...parts);
    view.querySelector('[data-show=devices]').parentNode.hidden = false;
  }
  scene.add(devices);

  // ---- motion ----

  const {motion} = data;
  const pathOf = one => ({
    p: one.p.map(axis => numbers(axis, motion.count)), q: one.q.map(part => numbers(part, motion.count))});
  const moving = motion.moving.map(one => ({body: bodies[one.body], index: one.body, ...pathOf(one)}));
  const carried = motion.parts.map((one, i) => ({body: parts[i], ...pathOf(one)}));
  /** The keyframe at or before a time, and how far it is to the next one. */
  function keyAt(time) {
    const at = clamp((time - data.begin) / motion.period, 0, motion.count - 1);
    const k = Math.min(Math.floor(at + 1e-6), motion.count - 2);
    return {k, s: clamp(at - k, 0, 1)};
  }
  const between = (channel, {k, s}) => channel[k] + s * (channel[k + 1] - channel[k]);
  function moveBodies(key) {
    for (const {body, p, q} of [...moving, ...carried]) {
      body.position.set(between(p[0], key), between(p[1], key), between(p[2], key));
      body.quaternion.set(between(q[1], key), between(q[2], key), between(q[3], key), between(q[0], key)).normalize();
    }
  }

  // ---- what is looked at ----

  const touched = new Set();
  for (const finger of motion.fingers) {
    finger.modes = numbers(finger.mode, motion.count);
    finger.bodies = numbers(finger.body, motion.count);
    finger.bodies.forEach((body, k) => { if (finger.modes[k] > 0.5) touched.add(Math.round(body)); });
  }
  const held = [...touched].filter(index => data.scene.bodies[index] && !data.scene.bodies[index].fixed);
  /** Box around a body wherever it goes. */
  function sweep(index) {
    const box = new THREE.Box3().setFromObject(bodies[index]), path = moving.find(one => one.index === index);
    if (!path) return box;
    const all = new THREE.Box3(), start = bodies[index].position, stride = Math.max(1, Math.floor(motion.count / 500));
    for (let k = 0; k < motion.count; k += stride)
      all.union(box.clone().translate(new THREE.Vector3(...path.p.map(axis => axis[k])).sub(start)));
    return all;
  }
  /** Where something happens: the bodies that fingers touch, and the fingers while they do; else what moves. */
  function extent() {
    const box = new THREE.Box3();
    for (const index of held.length ? held : moving.map(one => one.index)) box.union(sweep(index));
    for (const finger of motion.fingers) {
      const hip = finger.hip.map(axis => numbers(axis, motion.count));
      finger.modes.forEach((mode, k) => {
        if (mode > 0.5) box.expandByPoint(new THREE.Vector3(...hip.map(axis => axis[k])));
      });
    }
    if (box.isEmpty()) for (const body of bodies) box.expandByObject(body);
    return box.isEmpty() ? box.setFromCenterAndSize(new THREE.Vector3(), new THREE.Vector3(0.2, 0.2, 0.2)) : box;
  }
  const halfSize = box => box.getSize(new THREE.Vector3()).length() / 2;
  moveBodies(keyAt(data.begin));
  const box = extent(), followed = bodies[held.length ? held[0] : (moving[0] || {}).index];
  let middle = box.getCenter(new THREE.Vector3()), radius = clamp(1.12 * halfSize(box), 0.03, 1e5);
  const shown = {forces: true, cones: true, tips: true, devices: true, follow: false};
  const size = followed ? halfSize(new THREE.Box3().setFromObject(followed)) : 0;
  if (size > 0 && halfSize(sweep(bodies.indexOf(followed))) > 20 * size) {  // far away it would be a speck: go with it
    shown.follow = view.querySelector('[data-show=follow]').checked = true;
    radius = 4 * size;
    middle = followed.position.clone();
  }

  // ---- light and floor ----

  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8478, 0.62));
  const sun = new THREE.DirectionalLight(0xffffff, 0.72);
  sun.position.copy(middle).add(new THREE.Vector3(-0.9, -1.2, 2.4).multiplyScalar(2 * radius));
  sun.target.position.copy(middle);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  const wide = 2 * radius, reach = {near: radius / 10, far: 6 * wide};
  Object.assign(sun.shadow.camera, {left: -wide, right: wide, top: wide, bottom: -wide, ...reach});
  sun.shadow.bias = -0.0006;
  scene.add(sun, sun.target);
  const spacing = 10 ** Math.round(Math.log10(radius / 3)), lines = 40;
  let grid = null;
  function drawFloor() {
    const css = getComputedStyle(document.documentElement);
    const color = name => new THREE.Color(css.getPropertyValue(name).trim());
    scene.background = color('--card');  // background and fog are drawn as they are, all else from linear colours
    if (grid) scene.remove(grid);
    const line = color('--rule').convertSRGBToLinear();
    grid = new THREE.GridHelper(lines * spacing, lines, line, line);
    grid.rotation.x = Math.PI / 2;
    const onLine = value => Math.round(value / spacing) * spacing;
    grid.position.set(onLine(middle.x), onLine(middle.y), data.scene.floor);
    scene.add(grid);
    scene.fog = new THREE.Fog(scene.background.getHex(), 8 * radius, 8 * radius + lines * spacing / 2);
  }
  drawFloor();
  const where = view.querySelector('[data-now=grid]');
  where.textContent = 'grid ' + (spacing < 1 ? Math.round(spacing * 1000) + ' mm' : spacing + ' m');

  // ---- camera ----

  const controls = new THREE.OrbitControls(camera, canvas);
  controls.enableKeys = false;  // the arrow keys are those of time
  controls.screenSpacePanning = true;
  function resetView() {
    const narrow = Math.min(1, camera.aspect), at = shown.follow && followed ? followed.position : middle;
    const distance = 1.02 * radius / Math.sin(camera.fov * Math.PI / 360) / narrow;
    camera.near = distance / 300;
    camera.far = distance * 100;
    controls.target.copy(at);
    camera.position.copy(at).add(new THREE.Vector3(0.42, -0.86, 0.34).normalize().multiplyScalar(distance));
    camera.updateProjectionMatrix();
    controls.update();
  }
  const last = middle.clone();
  if (followed) last.copy(followed.position);
  function follow() {
    if (!followed) return;
    if (shown.follow) {
      const step = followed.position.clone().sub(last);
      camera.position.add(step);
      controls.target.add(step);
      camera.lookAt(controls.target);
      sun.position.add(step);
      sun.target.position.add(step);
    }
    last.copy(followed.position);
  }

  let contacts = null, waiting = false;
  function draw() {
    waiting = false;
    const key = keyAt(clock.shown);
    moveBodies(key);
    devices.visible = shown.devices;
    if (contacts) contacts.show(key, clock.shown, shown);
    follow();
    renderer.render(scene, camera);
  }
  const later = () => { if (!waiting) { waiting = true; requestAnimationFrame(draw); } };
  let fitted = false;
  function resize() {
    const width = view.clientWidth, height = view.clientHeight;
    if (!width || !height) return;
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    if (!fitted) { fitted = true; resetView(); }
    draw();
  }
  controls.addEventListener('change', later);
  new ResizeObserver(resize).observe(view);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { drawFloor(); later(); });
  presaReplay.listen(what => { if (what === 'time') later(); });
  for (const tick of view.querySelectorAll('[data-show]'))
    tick.addEventListener('change', () => { shown[tick.dataset.show] = tick.checked; later(); });
  view.querySelector('[data-do=view]').addEventListener('click', () => { resetView(); later(); });

  return {
    scene, camera, canvas, keyAt, between, count: motion.count, fingers: motion.fingers, draw, resize,
    use(glyphs) { contacts = glyphs; },
    /** Where a body's origin is in the view now [CSS pixels from its left and top edge]. */
    screenOf(name) {
      const body = bodies[data.scene.bodies.findIndex(one => one.name === name)];
      const p = body.position.clone().project(camera);
      return [(p.x + 1) / 2 * view.clientWidth, (1 - p.y) / 2 * view.clientHeight];
    },
    positionOf: name => bodies[data.scene.bodies.findIndex(one => one.name === name)].position.toArray(),
  };
})();
