// The body of a live session in three dimensions: corners shared by triangles, moved by each frame; what is under the pointer.

import {BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Points, PointsMaterial, Vector3} from 'three';

import {BodyView} from './body_view.js';
import {FIELDS, colourRange} from './colours.js';
import {styleColour} from './dom.js';

export class LiveView extends BodyView {
  /** @param frames  takeFrame() gives the newest frame or null  @param shown is called with each frame that was drawn */
  constructor(canvas, surface, up, moved, frames, shown) {
    super(canvas, surface, up, moved, false);
    this.frames = frames;
    this.shown = shown;
    this.field = 'displacement';
    this.makeFixed();
    this.takeTheme();
  }

  makeGeometry() {
    const geometry = new BufferGeometry();
    this.linePlaces.setUsage(DynamicDrawUsage);
    geometry.setAttribute('position', this.linePlaces);
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(3 * this.surface.vertices), 3).setUsage(DynamicDrawUsage));
    geometry.setIndex(new BufferAttribute(this.surface.corners, 1));
    return geometry;
  }

  /** Points at the vertices that the scene holds. */
  makeFixed() {
    const points = new BufferGeometry();
    points.setAttribute('position', this.linePlaces);
    points.setIndex([...this.surface.fixed.keys()].filter((vertex) => this.surface.fixed[vertex]));
    this.fixedPoints = new Points(points, new PointsMaterial({size: 3, sizeAttenuation: false}));
    this.fixedPoints.frustumCulled = false;
    this.scene.add(this.fixedPoints);
  }

  takeTheme() {
    super.takeTheme();
    if (this.fixedPoints) this.fixedPoints.material.color = new Color(styleColour('--ink'));
    if (this.fixedPoints) this.paint();
  }

  place() {
    const {surface, u, places} = this;
    surface.displacements(null, u);
    for (let i = 0; i < places.length; ++i) places[i] = surface.rest[i] + this.enlarged * u[i];
    this.linePlaces.needsUpdate = true;
  }

  paint() {
    const plain = this.field === 'plain', {material} = this.body;
    if (material.vertexColors === plain) {
      material.vertexColors = !plain;
      material.needsUpdate = true;
    }
    material.color.set(plain ? styleColour('--body') : '#fff');
    if (plain) return;
    const {u, surface} = this, colours = this.geometry.getAttribute('color');
    this.range = colourRange('displacement', [0, this.ofInstant ? surface.farthestNow : surface.farthest]);
    const table = this.colourTable(FIELDS.displacement.map), steps = (table.length - 1) / this.range[1];
    for (let i = 0; i < u.length; i += 3) {
      const [red, green, blue] = table[Math.min(table.length - 1, Math.round(steps * Math.hypot(u[i], u[i + 1], u[i + 2])))];
      colours.array[i] = red;
      colours.array[i + 1] = green;
      colours.array[i + 2] = blue;
    }
    colours.needsUpdate = true;
  }

  draw() {
    const frame = this.frames?.takeFrame();
    if (frame) {
      this.surface.take(frame);
      this.place();
      this.placeTools();
      this.paint();
    }
    super.draw();
    if (frame) this.shown(frame);
  }

  /** The vertex nearest to where the body is hit, of those that can be moved; null where there is none. */
  vertexAt(clientX, clientY) {
    const hit = this.hit(clientX, clientY);
    if (!hit) return null;
    const near = [hit.face.a, hit.face.b, hit.face.c].sort((a, b) => this.placeOf(a).distanceTo(hit.point) - this.placeOf(b).distanceTo(hit.point));
    const free = near.find((vertex) => !this.surface.fixed[vertex]);
    return {vertex: free ?? near[0], fixed: free === undefined};
  }

  /** The number of the tool under a point of the screen, or -1. */
  toolAt(clientX, clientY) {
    const seen = this.toolBodies.filter((tool) => tool.visible);
    seen.forEach((tool) => tool.updateMatrixWorld());
    const [hit] = this.sight(clientX, clientY).intersectObjects(seen);
    return hit ? this.toolBodies.indexOf(hit.object) : -1;
  }

  /** Where a vertex is drawn. */
  placeOf(vertex) {
    return new Vector3().fromArray(this.places, 3 * vertex);
  }

  /** A point under the pointer in the plane through a place that is parallel to the screen. */
  inPlane(place, clientX, clientY) {
    const {ray} = this.sight(clientX, clientY), towards = this.camera.getWorldDirection(new Vector3());
    const part = place.clone().sub(ray.origin).dot(towards) / ray.direction.dot(towards);
    return ray.at(part, new Vector3());
  }

  /** A place in pixels of the canvas; null if it is behind the camera. */
  project(place) {
    this.camera.updateMatrixWorld();
    const {x, y, z} = place.clone().project(this.camera);
    return z > 1 ? null : {x: (x + 1) / 2 * this.canvas.clientWidth, y: (1 - y) / 2 * this.canvas.clientHeight};
  }

  /** How many pixels a length is, at a place. */
  pixels(length, place) {
    const depth = place.clone().sub(this.camera.position).dot(this.camera.getWorldDirection(new Vector3()));
    return length * this.canvas.clientHeight / (2 * depth * Math.tan(this.camera.fov * Math.PI / 360));
  }
}
