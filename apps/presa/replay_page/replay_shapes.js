'use strict';
// Geometries and materials of the bodies for three.js. A function, as there is no three.js on a page without 3-D.
presaReplay.shapes = () => {
  const {data, numbers, bytes} = presaReplay;
  const kCrease = Math.cos(40 * Math.PI / 180);  // facets that meet more sharply keep their edge
  function creased(position, corners) {
    const facets = corners.length / 3;
    const normals = new Float32Array(corners.length * 3), out = new Float32Array(corners.length * 3);
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
  function capsuleGeometry(radius, length) {
    const profile = [];
    for (let i = 0; i <= 32; ++i) {
      const angle = (i / 32 - 0.5) * Math.PI, middle = (i <= 16 ? -1 : 1) * length / 2;
      profile.push(new THREE.Vector2(Math.max(1e-9, radius * Math.cos(angle)), radius * Math.sin(angle) + middle));
      if (i === 16) profile.push(new THREE.Vector2(radius, length / 2));
    }
    return upright(new THREE.LatheBufferGeometry(profile, 48));
  }
  const made = new Map();  // equal shapes share their geometry
  function primitive({box, sphere, cylinder, capsule}) {
    if (box) return new THREE.BoxBufferGeometry(...box);
    if (sphere) return new THREE.SphereBufferGeometry(sphere, 48, 32);
    if (cylinder) return upright(new THREE.CylinderBufferGeometry(cylinder[0], cylinder[0], cylinder[1], 64));
    return capsule ? capsuleGeometry(...capsule) : new THREE.BufferGeometry();
  }
  function geometryOf(shape) {
    if ('mesh' in shape) return meshes[shape.mesh];
    const key = JSON.stringify({...shape, pose: 0});
    if (!made.has(key)) made.set(key, primitive(shape));
    return made.get(key);
  }
  const materials = new Map();
  function materialOf(color) {
    const key = color.join(), look = {color: new THREE.Color(...color), roughness: 0.72, metalness: 0, fog: false};
    if (!materials.has(key)) materials.set(key, new THREE.MeshStandardMaterial(look));
    return materials.get(key);
  }

  return {geometryOf, materialOf};
};
