// The body in three dimensions.

import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, EdgesGeometry, LineBasicMaterial, LineSegments,
  Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Raycaster, Scene, SRGBColorSpace, Vector2, Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {FIELDS, colourAt, colourRange} from './colours.js';
import {styleColour} from './dom.js';

const N_COLOURS = 256;

/** Upwards, and the direction to look from: against gravity; without it, lying on the screen. */
function directions(surface, up) {
  if (surface.flat) return {up: new Vector3(0, 1, 0), towards: new Vector3(0, 0, 1)};
  const [x, y, z] = surface.extent;
  const upward = up ? new Vector3(...up).normalize() : (y > Math.max(x, z) ? new Vector3(0, 0, 1) : new Vector3(0, 1, 0));
  if (Math.abs(upward.z) > 0.9)
    return {up: upward, towards: y >= x ? new Vector3(-1.2, -0.7, 0.6) : new Vector3(0.6, -1.25, 0.6)};
  if (Math.abs(upward.y) > 0.9)
    return {up: upward, towards: z > x ? new Vector3(1.25, 0.6, 0.5) : new Vector3(0.5, 0.65, 1.2)};
  return {up: upward, towards: new Vector3(0.4, -1, 0.6)};
}

export class BodyView {
  /** @param moved is called with the camera whenever the body was drawn anew */
  constructor(canvas, surface, up, moved, keepPicture = true) {
    this.canvas = canvas;
    this.surface = surface;
    this.moved = moved;
    this.field = 'von_mises_stress';
    this.enlarged = 1;
    this.ofInstant = false;
    this.where = surface.at(0);
    this.renderer = new WebGLRenderer({canvas, antialias: devicePixelRatio < 2, preserveDrawingBuffer: keepPicture});
    this.renderer.debug.checkShaderErrors = false; // it would wait for each shader
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(24, 1, 0.01, 100);
    this.directions = directions(surface, up);
    this.camera.up.copy(this.directions.up);
    this.camera.position.copy(this.directions.towards);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.invalidate());
    this.makeBody();
    this.makeGhost();
    this.makeTools();
    this.addLights();
    this.takeTheme();
    canvas.addEventListener('keydown', (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    this.reset();
  }

  /** Each triangle has corners of its own, for it has a colour of its own. */
  makeGeometry() {
    const {triangles} = this.surface, geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(9 * triangles), 3));
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(9 * triangles), 3));
    return geometry;
  }

  makeBody() {
    const {vertices, triangles, corners} = this.surface;
    this.u = new Float32Array(3 * vertices);
    this.places = new Float32Array(3 * vertices);
    this.values = new Float32Array(triangles);
    this.linePlaces = new BufferAttribute(this.places, 3);
    this.geometry = this.makeGeometry();
    const material = new MeshLambertMaterial({vertexColors: true, flatShading: true, side: DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1});
    this.body = new Mesh(this.geometry, material);
    this.body.frustumCulled = false;

    const edges = new Map();
    for (let i = 0; i < corners.length; i += 3)
      for (let e = 0; e < 3; ++e) {
        const [a, b] = [corners[i + e], corners[i + (e + 1) % 3]].sort((p, q) => p - q);
        edges.set(a * vertices + b, [a, b]);
      }
    const lines = new BufferGeometry();
    lines.setAttribute('position', this.linePlaces);
    lines.setIndex([...edges.values()].flat());
    this.wires = new LineSegments(lines, new LineBasicMaterial({transparent: true, opacity: 0.55}));
    this.wires.frustumCulled = false;
    this.scene.add(this.body, this.wires);
  }

  makeGhost() {
    const shape = new BufferGeometry();
    shape.setAttribute('position', new BufferAttribute(this.surface.rest, 3));
    shape.setIndex([...this.surface.corners]);
    this.ghostFaces = new Mesh(shape, new MeshBasicMaterial({transparent: true, opacity: 0.07, depthWrite: false, side: DoubleSide}));
    this.ghostEdges = new LineSegments(new EdgesGeometry(shape, 40), new LineBasicMaterial({transparent: true, opacity: 0.8}));
    this.scene.add(this.ghostFaces, this.ghostEdges);
  }

  makeTools() {
    this.toolMaterial = new MeshLambertMaterial({transparent: true, opacity: 0.45, depthWrite: false, side: DoubleSide, flatShading: true});
    this.toolBodies = this.surface.tools.map(({points, triangles}) => {
      const shape = new BufferGeometry();
      shape.setAttribute('position', new BufferAttribute(Float32Array.from(points), 3));
      shape.setIndex(triangles);
      const tool = new Mesh(shape, this.toolMaterial);
      tool.frustumCulled = false;
      this.scene.add(tool);
      return tool;
    });
  }

  /** Tools are where they are: beside an enlarged displacement they would mean nothing. */
  placeTools() {
    this.toolBodies.forEach((tool, number) => {
      const pose = this.surface.pose(number, this.where);
      const turn = new Vector3(...pose.slice(3));
      tool.visible = this.enlarged === 1;
      tool.position.set(...pose.slice(0, 3));
      tool.quaternion.setFromAxisAngle(turn.clone().normalize(), turn.length());
    });
  }

  /** From beside the camera, so that what one looks at is lit. */
  addLights() {
    const light = new DirectionalLight(0xffffff, 0.45 * Math.PI);
    light.position.set(0.3, 0.8, 1);
    this.camera.add(light);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 0.66 * Math.PI));
  }

  takeTheme() {
    this.scene.background = new Color(styleColour('--stage'));
    const line = new Color(styleColour('--ghost'));
    this.ghostFaces.material.color = line;
    this.ghostEdges.material.color = line;
    this.wires.material.color = new Color(styleColour('--wire'));
    this.toolMaterial.color = line;
    this.invalidate();
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    const wasAspect = this.camera.aspect;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.fitted && Math.abs(wasAspect - this.camera.aspect) > 0.05) this.reset();
    this.invalidate();
  }

  /** Looks at the whole motion from where it began. */
  reset() {
    const {low, high} = this.surface.box(this.enlarged);
    const middle = new Vector3(...low).add(new Vector3(...high)).multiplyScalar(0.5);
    const towards = this.directions.towards.clone().normalize();
    const right = new Vector3().crossVectors(this.directions.up, towards).normalize();
    const upward = new Vector3().crossVectors(towards, right);
    const tangent = Math.tan(this.camera.fov * Math.PI / 360);
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const arm = new Vector3(...[0, 1, 2].map((d) => ((corner >> d) & 1 ? high : low)[d])).sub(middle);
      const reach = Math.max(Math.abs(arm.dot(upward)), Math.abs(arm.dot(right)) / this.camera.aspect);
      distance = Math.max(distance, 1.08 * reach / tangent + arm.dot(towards));
    }
    this.camera.near = distance / 100;
    this.camera.far = distance * 20;
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).addScaledVector(towards, distance);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.fitted = true;
    this.invalidate();
  }

  /** Turns and zooms by the keyboard. */
  key(event) {
    const turns = {ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, 0.12], ArrowDown: [0, -0.12]};
    const arm = this.camera.position.clone().sub(this.controls.target);
    if (turns[event.key]) {
      const [aside, above] = turns[event.key];
      const right = new Vector3().crossVectors(this.camera.up, arm).normalize();
      const angle = arm.angleTo(this.camera.up);
      if (angle - above > 0.05 && angle - above < Math.PI - 0.05) arm.applyAxisAngle(right, -above);
      arm.applyAxisAngle(this.camera.up, aside);
    } else if (event.key === '+' || event.key === '=') arm.multiplyScalar(1 / 1.15);
    else if (event.key === '-') arm.multiplyScalar(1.15);
    else if (event.key === '0') return this.reset();
    else return undefined;
    event.preventDefault();
    event.stopPropagation();
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.invalidate();
    return undefined;
  }

  show({time, field, enlarged, wires, ghost, ofInstant}) {
    if (time !== undefined) this.where = this.surface.at(time);
    if (field !== undefined) this.field = field;
    if (enlarged !== undefined) this.enlarged = enlarged;
    if (ofInstant !== undefined) this.ofInstant = ofInstant;
    if (wires !== undefined) this.wires.visible = wires;
    if (ghost !== undefined) this.ghostFaces.visible = this.ghostEdges.visible = ghost;
    this.place();
    this.placeTools();
    this.paint();
    this.invalidate();
  }

  place() {
    const {rest, corners} = this.surface;
    this.surface.displacements(this.where, this.u);
    for (let i = 0; i < rest.length; ++i) this.places[i] = rest[i] + this.enlarged * this.u[i];
    const position = this.geometry.getAttribute('position');
    for (let c = 0; c < corners.length; ++c)
      for (let d = 0; d < 3; ++d) position.array[3 * c + d] = this.places[3 * corners[c] + d];
    position.needsUpdate = true;
    this.linePlaces.needsUpdate = true;
  }

  /** A number for each corner of a triangle. */
  cornerValue() {
    const {corners, materialIds} = this.surface;
    if (this.field === 'displacement') {
      const u = this.u;
      return (c) => Math.hypot(u[3 * corners[c]], u[3 * corners[c] + 1], u[3 * corners[c] + 2]);
    }
    if (this.field === 'material') return (c) => materialIds[Math.floor(c / 3)];
    this.surface.values(this.field, this.where, this.values);
    return (c) => this.values[Math.floor(c / 3)];
  }

  paint() {
    const {corners, materials} = this.surface;
    const value = this.cornerValue();
    let range = this.field === 'material' ? [materials[0], materials.at(-1)] : this.surface.coloured[this.field];
    if (this.ofInstant && this.field !== 'material') {
      range = [Infinity, -Infinity];
      for (let c = 0; c < corners.length; ++c) range = [Math.min(range[0], value(c)), Math.max(range[1], value(c))];
    }
    this.range = colourRange(this.field, range);
    const [low, high] = this.range;
    const table = this.colourTable(FIELDS[this.field].map);
    const colour = this.geometry.getAttribute('color');
    for (let c = 0; c < corners.length; ++c) {
      const part = high > low ? (value(c) - low) / (high - low) : 0.5;
      colour.array.set(table[Math.round((N_COLOURS - 1) * Math.min(1, Math.max(0, part)))], 3 * c);
    }
    colour.needsUpdate = true;
  }

  colourTable(map) {
    if (this.tableOf !== map) {
      this.tableOf = map;
      this.table = Array.from({length: N_COLOURS}, (_, i) =>
        new Color().setRGB(...colourAt(map, i / (N_COLOURS - 1)), SRGBColorSpace).toArray());
    }
    return this.table;
  }

  /** The line of sight through a point of the screen. */
  sight(clientX, clientY) {
    const box = this.canvas.getBoundingClientRect();
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(2 * (clientX - box.left) / box.width - 1, 1 - 2 * (clientY - box.top) / box.height), this.camera);
    return caster;
  }

  /** Where it meets the body first; undefined if it does not. */
  hit(clientX, clientY) {
    this.geometry.boundingSphere = null;
    this.geometry.boundingBox = null;
    return this.sight(clientX, clientY).intersectObject(this.body)[0];
  }

  /** The value under a point of the screen, or null. */
  valueAt(clientX, clientY) {
    const hit = this.hit(clientX, clientY);
    return hit ? this.cornerValue()(3 * hit.faceIndex) : null;
  }

  /** Draws at the next opportunity. */
  invalidate() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
    this.moved(this.camera);
  }
}
