'use strict';
// The bodies in 3-D. Nothing here runs where there is no WebGL or no scene.
presaReplay.scene = (() => {
  const {data, numbers, bytes, clock, clamp} = presaReplay;
  const view = document.querySelector('.replay-view'), canvas = view.querySelector('.replay-canvas');
  const refuse = why => {
    canvas.remove();
    for (const part of view.querySelectorAll('.replay-tools, .replay-key')) part.remove();
    const line = view.querySelector('.replay-trouble');
    line.textContent = why;
    line.hidden = false;
    return null;
  };
  if (!data.scene) return refuse('No 3-D view: the scene of this recording cannot be loaded again here (' + data.trouble + '). The plots are whole.');
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

  const kCrease = Math.cos(40 * Math.PI / 180);  // facets that meet more sharply keep their edge
  function creased(position, corners) {
    const facets = corners.length / 3, normals = new Float32Array(corners.length * 3), out = new Float32Array(corners.length * 3);
    const face = Array.from({length: facets}, () => new THREE.Vector3()), around = new Map();
    const at = i => new THREE.Vector3().fromArray(position, 3 * i);
    for (let f = 0; f < facets; ++f) {
      const [a, b, c] = [0, 1, 2].map(k => at(corners[3 * f + k]));
      face[f].copy(b).sub(a).cross(c.sub(a));  // as long as twice the area: large facets count more
      for (let k = 0; k < 3; ++k) {
        const corner = corners[3 * f + k];
        if (!around.has(corner)) around.set(corner, []);
        around.get(corner).push(f);
      }
    }
    const unit = face.map(n => n.clone().normalize()), sum = new THREE.Vector3();
    for (let i = 0; i < corners.length; ++i) {
      const own = unit[Math.floor(i / 3)];
      sum.set(0, 0, 0);
      for (const f of around.get(corners[i])) if (unit[f].dot(own) > kCrease) sum.add(face[f]);
      sum.normalize().toArray(normals, 3 * i);
      at(corners[i]).toArray(out, 3 * i);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(out, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
    return geometry;
  }
  const meshes = data.scene.meshes.map(mesh => {
    const corners = bytes(mesh.i).buffer;
    return creased(numbers(mesh.v, 3), mesh.wide ? new Uint32Array(corners) : new Uint16Array(corners));
  });
  // three.js has its cylinders along y
  const upright = geometry => geometry.rotateX(Math.PI / 2);
  function capsule(radius, length) {
    const profile = [];
    for (let i = 0; i <= 32; ++i) {
      const angle = (i / 32 - 0.5) * Math.PI;
      profile.push(new THREE.Vector2(Math.max(1e-9, radius * Math.cos(angle)), radius * Math.sin(angle) + (i <= 16 ? -1 : 1) * length / 2));
      if (i === 16) profile.push(new THREE.Vector2(radius, length / 2));
    }
    return upright(new THREE.LatheBufferGeometry(profile, 48));
  }
  const made = new Map();  // equal shapes share their geometry
  function geometryOf(shape) {
    if ('mesh' in shape) return meshes[shape.mesh];
    const key = JSON.stringify({...shape, pose: 0});
    if (!made.has(key)) {
      made.set(key, shape.box ? new THREE.BoxBufferGeometry(...shape.box)
        : shape.sphere ? new THREE.SphereBufferGeometry(shape.sphere, 48, 32)
        : shape.cylinder ? upright(new THREE.CylinderBufferGeometry(shape.cylinder[0], shape.cylinder[0], shape.cylinder[1], 64))
        : shape.capsule ? capsule(...shape.capsule) : new THREE.BufferGeometry());
    }
    return made.get(key);
  }
  const materials = new Map();
  function materialOf(color) {
    const key = color.join();
    if (!materials.has(key))
      materials.set(key, new THREE.MeshStandardMaterial({color: new THREE.Color(...color), roughness: 0.72, metalness: 0}));
    return materials.get(key);
  }
  function place(object, pose) {
    object.position.set(pose[0], pose[1], pose[2]);
    object.quaternion.set(pose[4], pose[5], pose[6], pose[3]);
  }
  const bodies = data.scene.bodies.map(body => {
    const group = new THREE.Group();
    for (const shape of body.shapes) {
      const mesh = new THREE.Mesh(geometryOf(shape), materialOf(body.color));
      mesh.castShadow = mesh.receiveShadow = true;
      place(mesh, shape.pose);
      group.add(mesh);
    }
    place(group, body.pose);
    scene.add(group);
    return group;
  });

  // ---- motion ----

  const {motion} = data;
  const moving = motion.moving.map(one => ({
    body: bodies[one.body], index: one.body,
    p: one.p.map(axis => numbers(axis, motion.count)), q: one.q.map(part => numbers(part, motion.count))}));
  /** The keyframe at or before a time, and how far it is to the next one. */
  function keyAt(time) {
    const at = clamp((time - data.begin) / motion.period, 0, motion.count - 1);
    const k = Math.min(Math.floor(at + 1e-6), motion.count - 2);
    return {k, s: clamp(at - k, 0, 1)};
  }
  const between = (channel, {k, s}) => channel[k] + s * (channel[k + 1] - channel[k]);
  function moveBodies(key) {
    for (const {body, p, q} of moving) {
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
  const held = data.scene.bodies.map((body, index) => index).filter(index => touched.has(index) && !data.scene.bodies[index].fixed);
  /** Box around a body wherever it goes. */
  function sweep(index) {
    const box = new THREE.Box3().setFromObject(bodies[index]), path = moving.find(one => one.index === index);
    if (!path) return box;
    const all = new THREE.Box3(), start = bodies[index].position, stride = Math.max(1, Math.floor(motion.count / 500));
    for (let k = 0; k < motion.count; k += stride)
      all.union(box.clone().translate(new THREE.Vector3(path.p[0][k] - start.x, path.p[1][k] - start.y, path.p[2][k] - start.z)));
    return all;
  }
  /** Where something happens: the bodies that fingers touch, and the fingers while they do; else what moves. */
  function extent() {
    const box = new THREE.Box3();
    for (const index of held.length ? held : moving.map(one => one.index)) box.union(sweep(index));
    for (const finger of motion.fingers) {
      const hip = finger.hip.map(axis => numbers(axis, motion.count));
      finger.modes.forEach((mode, k) => { if (mode > 0.5) box.expandByPoint(new THREE.Vector3(hip[0][k], hip[1][k], hip[2][k])); });
    }
    if (box.isEmpty()) for (const body of bodies) box.expandByObject(body);
    return box.isEmpty() ? box.setFromCenterAndSize(new THREE.Vector3(), new THREE.Vector3(0.2, 0.2, 0.2)) : box;
  }
  const halfSize = box => box.getSize(new THREE.Vector3()).length() / 2;
  moveBodies(keyAt(data.begin));
  const box = extent(), followed = bodies[held.length ? held[0] : (moving[0] || {}).index];
  let middle = box.getCenter(new THREE.Vector3()), radius = clamp(1.12 * halfSize(box), 0.03, 1e5);
  const shown = {forces: true, cones: true, tips: true, follow: false};
  if (followed && radius > 20 * halfSize(new THREE.Box3().setFromObject(followed))) {  // it would be a speck: go with it
    shown.follow = view.querySelector('[data-show=follow]').checked = true;
    radius = 4 * halfSize(new THREE.Box3().setFromObject(followed));
    middle = followed.position.clone();
  }

  // ---- light and floor ----

  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8478, 0.62));
  const sun = new THREE.DirectionalLight(0xffffff, 0.72);
  sun.position.copy(middle).add(new THREE.Vector3(-0.9, -1.2, 2.4).multiplyScalar(2 * radius));
  sun.target.position.copy(middle);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  Object.assign(sun.shadow.camera, {left: -2 * radius, right: 2 * radius, top: 2 * radius, bottom: -2 * radius, near: radius / 10, far: 12 * radius});
  sun.shadow.bias = -0.0006;
  scene.add(sun, sun.target);
  const spacing = 10 ** Math.round(Math.log10(radius / 3)), lines = 40;
  let grid = null;
  function drawFloor() {
    const css = getComputedStyle(document.documentElement), color = name => new THREE.Color(css.getPropertyValue(name).trim());
    scene.background = color('--card');  // background and fog are drawn as they are, all else from linear colours
    if (grid) scene.remove(grid);
    const line = color('--rule').convertSRGBToLinear();
    grid = new THREE.GridHelper(lines * spacing, lines, line, line);
    grid.rotation.x = Math.PI / 2;
    grid.position.set(Math.round(middle.x / spacing) * spacing, Math.round(middle.y / spacing) * spacing, data.scene.floor);
    scene.add(grid);
    scene.fog = new THREE.Fog(scene.background.getHex(), 8 * radius, 8 * radius + lines * spacing / 2);
    for (const material of materials.values()) material.fog = false;
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
