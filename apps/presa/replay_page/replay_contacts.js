'use strict';
// Fingertips, forces and friction cones of the 3-D view.
if (presaReplay.scene) (() => {
  const {data, numbers, binAt, stateOf} = presaReplay, {scene, between, count, fingers} = presaReplay.scene;
  const kPerNewton = 0.01;  // length of an arrow [m/N]
  const color = hex => new THREE.Color(hex).convertSRGBToLinear();
  const colors = {stick: color('#1f7fd6'), slip: color('#f07a00'), free: color('#8b95a0')};
  const kUp = new THREE.Vector3(0, 1, 0), kForward = new THREE.Vector3(0, 0, 1);

  const standing = geometry => geometry.translate(0, 0.5, 0);  // from the origin along y
  const shaft = standing(new THREE.CylinderBufferGeometry(1, 1, 1, 24));
  const head = standing(new THREE.ConeBufferGeometry(1, 1, 32));
  const cone = standing(new THREE.CylinderBufferGeometry(1, 0, 1, 64, 1, true));
  const ball = new THREE.SphereBufferGeometry(1, 40, 28);
  const rim = new THREE.TorusBufferGeometry(1, 0.012, 8, 64).rotateX(Math.PI / 2).translate(0, 1, 0);
  const matt = (hex, more) => new THREE.MeshStandardMaterial({color: color(hex), roughness: 0.6, fog: false, ...more});
  const clear = opacity => matt('#ffffff', {transparent: true, opacity, depthWrite: false, side: THREE.DoubleSide});
  const add = (geometry, material) => {
    const mesh = new THREE.Mesh(geometry, material);
    scene.add(mesh);
    return mesh;
  };

  const yellow = matt('#f2c500', {emissive: color('#6b5600')});
  const glyphs = fingers.map((finger, index) => {
    const channels = name => finger[name].map(axis => numbers(axis, count));
    const seen = matt('#14202c', {depthTest: false, transparent: true, opacity: 0.85});  // through the body, too
    const glyph = {
      finger, valid: numbers(finger.valid, count), seen: data.signals.states[index].seen,
      mu: finger.bodies.map(body => (data.scene.bodies[Math.round(body)] || {mu: 0}).mu),
      tip: add(ball, clear(0.62)), hip: add(ball, seen), link: add(shaft, seen),
      cone: add(cone, clear(0.3)), rim: add(rim, clear(0.9)), shaft: add(shaft, yellow), head: add(head, yellow),
    };
    for (const name of ['hip', 'proxy', 'contact', 'normal', 'force']) glyph[name + 's'] = channels(name);
    if (finger.tool) {
      glyph.tools = channels('tool');
      glyph.pen = add(shaft, matt('#5b6570'));
    }
    glyph.tip.castShadow = true;
    glyph.hip.renderOrder = glyph.link.renderOrder = 2;
    return glyph;
  });

  const vector = (axes, key) => new THREE.Vector3(between(axes[0], key), between(axes[1], key), between(axes[2], key));
  function along(mesh, from, direction, width, length) {
    mesh.position.copy(from);
    mesh.quaternion.setFromUnitVectors(kUp, direction.clone().normalize());
    mesh.scale.set(width, length, width);
  }

  function showForce(glyph, contact, key, state, shown) {
    const force = vector(glyph.forces, key), length = kPerNewton * force.length();
    const touches = state !== 'free', pulled = touches && shown.forces && length > 1e-4;
    glyph.shaft.visible = glyph.head.visible = pulled;
    if (pulled) {
      const tip = Math.min(0.009, 0.6 * length), thick = tip / 0.009;
      along(glyph.shaft, contact, force, 0.0013 * thick, length - tip);
      const neck = contact.clone().addScaledVector(force.clone().normalize(), length - tip);
      along(glyph.head, neck, force, 0.0034 * thick, tip);
    }
    // as high as the normal force: the arrow ends within the rim until the contact slips
    const normal = vector(glyph.normals, key).normalize();
    const height = Math.min(0.12, kPerNewton * force.dot(normal)), mu = glyph.mu[key.k];
    glyph.cone.visible = glyph.rim.visible = touches && shown.cones && height > 1e-3 && mu > 0;
    if (!glyph.cone.visible) return;
    for (const part of [glyph.cone, glyph.rim]) {
      along(part, contact, normal, mu * height, height);
      part.material.color.copy(colors[state]);
    }
  }

  presaReplay.scene.use({
    show(key, time, shown) {
      for (const glyph of glyphs) {
        const state = stateOf(glyph.seen[binAt(time)]);
        const hip = vector(glyph.hips, key), proxy = vector(glyph.proxys, key);
        const radius = Math.max(glyph.finger.radius, 0.0015), apart = proxy.clone().sub(hip);
        const valid = glyph.valid[key.k] > 0.5;
        glyph.tip.visible = glyph.hip.visible = shown.tips && valid;
        glyph.link.visible = glyph.tip.visible && apart.length() > 1e-5;
        glyph.tip.position.copy(proxy);
        glyph.tip.scale.setScalar(radius);
        glyph.tip.material.color.copy(colors[state]);
        glyph.hip.position.copy(hip);
        glyph.hip.scale.setScalar(Math.min(0.0022, radius));
        if (glyph.link.visible) along(glyph.link, hip, apart, 0.0007, apart.length());
        if (glyph.pen) {
          const [w, x, y, z] = glyph.tools.map(part => between(part, key));
          const axis = kForward.clone().applyQuaternion(new THREE.Quaternion(x, y, z, w).normalize());
          along(glyph.pen, proxy, axis, 0.003, 0.12);
          glyph.pen.visible = glyph.tip.visible && !(glyph.finger.device && shown.devices);
        }
        showForce(glyph, vector(glyph.contacts, key), key, state, shown);
      }
    },
  });
})();
