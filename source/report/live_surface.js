// The surface of a body in a live session, and the frames in which it moves.

import {boxOf} from './surface.js';

const MAGIC = 0x4c505553; // "SUPL"
const HEADER = 64; // bytes
const POSE = 24; // bytes of a tool: place and turn

/** A frame as the program sends it. @throws if it is not of this surface */
export function readFrame(buffer, {vertices, tools}) {
  const view = new DataView(buffer);
  if (buffer.byteLength !== HEADER + POSE * tools.length + 6 * vertices || view.getUint32(0, true) !== MAGIC || view.getUint32(36, true) !== tools.length)
    throw new Error('The program sent a frame of another body.');
  const flags = view.getUint32(32, true);
  return {
    time: view.getFloat64(8, true), step: view.getUint32(16, true), command: view.getUint32(20, true), scale: view.getFloat32(24, true),
    realTime: view.getFloat32(28, true), running: (flags & 1) !== 0, slow: (flags & 2) !== 0,
    stepsPerSecond: view.getFloat32(40, true), stepMilliseconds: view.getFloat32(44, true), session: view.getUint32(48, true),
    poses: new Float32Array(buffer, HEADER, 6 * tools.length), displacement: new Int16Array(buffer, HEADER + POSE * tools.length, 3 * vertices),
  };
}

/** What BodyView draws: the rest places, and the displacements of the newest frame. */
export class LiveSurface {
  /** @param buffer rest places, corners, numbers of the vertices in the mesh, and which of them the scene holds */
  constructor({vertices, triangles, tools, flat}, buffer) {
    if (buffer.byteLength !== 17 * vertices + 12 * triangles) throw new Error('The surface of the body is incomplete.');
    Object.assign(this, {vertices, triangles, flat});
    this.rest = new Float32Array(buffer, 0, 3 * vertices);
    this.corners = new Uint32Array(buffer, 12 * vertices, 3 * triangles);
    this.numbers = new Uint32Array(buffer, 12 * (vertices + triangles), vertices);
    this.fixed = new Uint8Array(buffer, 16 * vertices + 12 * triangles, vertices);
    this.placeOfNumber = new Map(Array.from(this.numbers, (number, place) => [number, place]));
    this.tools = tools;
    this.poses = new Float32Array(tools.flatMap(({place}) => [...place, 0, 0, 0]));
    this.displacement = new Int16Array(3 * vertices);
    this.scale = 0;
    this.farthest = 0;
    this.farthestNow = 0;
    Object.assign(this, boxOf(this.rest));
  }

  /** The newest frame is what is shown. */
  take({displacement, scale, poses}) {
    Object.assign(this, {displacement, poses, scale: scale / 32767});
    let square = 0;
    for (let i = 0; i < displacement.length; i += 3)
      square = Math.max(square, displacement[i] ** 2 + displacement[i + 1] ** 2 + displacement[i + 2] ** 2);
    this.farthestNow = Math.sqrt(square) * this.scale;
    this.farthest = Math.max(this.farthest, this.farthestNow);
  }

  at() {
    return null;
  }

  displacements(_, into) {
    for (let i = 0; i < into.length; ++i) into[i] = this.scale * this.displacement[i];
  }

  pose(tool) {
    return [...this.poses.subarray(6 * tool, 6 * tool + 6)];
  }

  /** The body as it is, with room around it, and the tools that are near. */
  box() {
    const low = this.low.map((x) => x - 0.06 * this.diameter), high = this.high.map((x) => x + 0.06 * this.diameter);
    const reach = (place, far) => place.forEach((x, d) => {
      low[d] = Math.min(low[d], Math.max(x, this.low[d] - far));
      high[d] = Math.max(high[d], Math.min(x, this.high[d] + far));
    });
    for (let i = 0; i < this.rest.length; i += 3)
      reach([0, 1, 2].map((d) => this.rest[i + d] + this.scale * this.displacement[i + d]), this.diameter);
    this.tools.forEach((_, tool) => reach(this.pose(tool).slice(0, 3), 0.25 * this.diameter));
    if (this.flat) [low[2], high[2]] = [0, 0];
    return {low, high};
  }
}
