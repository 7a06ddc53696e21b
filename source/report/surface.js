// The surface of the body in its frames, as source/output/film.cc packs it.

/** Bytes of base64. */
function decode(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}

/** Values of all frames, 16 bits each, from the differences between frames. */
async function unpack(stream, length) {
  const bytes = new Uint8Array(await new Response(new Blob([stream]).stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer());
  const values = new Uint16Array(bytes.length / 2);
  for (let begin = 0; begin < values.length; begin += length)
    for (let i = 0; i < length; ++i) {
      const folded = bytes[2 * begin + i] | bytes[2 * begin + length + i] << 8;
      values[begin + i] = (folded >> 1 ^ -(folded & 1)) + (begin > 0 ? values[begin + i - length] : 0);
    }
  return values;
}

/** Fields of the triangles, in the order in which a frame has them; the last two are not in all pages. */
const FIELDS = ['volume_ratio', 'von_mises_stress', 'contact_pressure', 'error_in_space'];

/** Of places, three numbers each: the corners of their box, how long that is, and its diagonal. */
export function boxOf(places) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  places.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  const extent = high.map((most, d) => most - low[d]);
  return {low, high, extent, diameter: Math.hypot(...extent)};
}

export class Surface {
  /** @throws where the browser can't unpack the frames */
  static async read(description, text) {
    const buffer = decode(text);
    const {vertices, triangles} = description;
    const begin = 12 * vertices + 12 * triangles + 4 * Math.ceil(triangles / 2);
    const fields = FIELDS.filter((field) => description[field]);
    return new Surface(description, fields, buffer, await unpack(buffer.slice(begin), 3 * vertices + fields.length * triangles));
  }

  constructor(description, fields, buffer, values) {
    Object.assign(this, description);
    const {vertices, triangles} = description;
    this.rest = new Float32Array(buffer, 0, 3 * vertices);
    this.corners = new Uint32Array(buffer, 12 * vertices, 3 * triangles);
    const places = new Uint16Array(buffer, 12 * (vertices + triangles), 2 * Math.ceil(triangles / 2));
    this.materialIds = Uint32Array.from(places, (place) => this.materials[place]);
    this.frames = this.times.map((_, number) => {
      const at = number * (3 * vertices + fields.length * triangles);
      const frame = {displacement: new Int16Array(values.buffer, 2 * at, 3 * vertices)};
      fields.forEach((field, i) => {
        frame[field] = values.subarray(at + 3 * vertices + i * triangles, at + 3 * vertices + (i + 1) * triangles);
      });
      return frame;
    });
    this.range = Object.fromEntries(fields.map((field) => [field, description[field]]));
    this.flat = this.rest.every((value, i) => i % 3 !== 2 || value === 0);
    this.measure();
  }

  /** Extent at rest, farthest motion, and the box that all frames lie in, for any enlargement. */
  measure() {
    Object.assign(this, boxOf(this.rest));

    const scale = this.largest_displacement / 32767;
    this.farthest = 0;
    this.farthestFrame = 0;
    this.frames.forEach(({displacement: u}, number) => {
      let square = 0;
      for (let i = 0; i < u.length; i += 3) square = Math.max(square, u[i] ** 2 + u[i + 1] ** 2 + u[i + 2] ** 2);
      const length = Math.sqrt(square) * scale;
      if (length > this.farthest) [this.farthest, this.farthestFrame] = [length, number];
    });
    this.range.displacement = [0, this.farthest];
    this.coloured = {...this.range, von_mises_stress: this.commonStresses()};
  }

  /** The area of a triangle at rest. */
  area(c) {
    const [p, q, r] = [0, 1, 2].map((i) => this.rest.subarray(3 * this.corners[3 * c + i], 3 * this.corners[3 * c + i] + 3));
    const u = [0, 1, 2].map((d) => q[d] - p[d]), v = [0, 1, 2].map((d) => r[d] - p[d]);
    return Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }

  /** The range of the stresses but for those far above all others on a hundredth of the surface: at a needle or a corner
   * these would leave no colours for the rest. */
  commonStresses() {
    const [low, high] = this.range.von_mises_stress;
    const areas = Float64Array.from({length: this.corners.length / 3}, (_, c) => this.area(c));
    const all = areas.reduce((sum, area) => sum + area, 0);
    let most = 0;
    for (const {von_mises_stress: values} of this.frames) {
      const order = Uint32Array.from(areas.keys()).sort((a, b) => values[b] - values[a]);
      let above = 0, i = 0;
      while (i < order.length - 1 && above + areas[order[i]] < 0.01 * all) above += areas[order[i++]];
      most = Math.max(most, values[order[i]]);
    }
    const common = low + (high - low) * most / 65535;
    return most > 0 && common < 0.5 * high ? [low, common] : [low, high];
  }

  /** The box of all frames with so many times the displacement. */
  box(enlarged) {
    const low = [...this.low], high = [...this.high];
    const scale = enlarged * this.largest_displacement / 32767;
    for (const {displacement: u} of this.frames)
      for (let i = 0; i < u.length; ++i) {
        const x = this.rest[i] + scale * u[i];
        if (x < low[i % 3]) low[i % 3] = x;
        if (x > high[i % 3]) high[i % 3] = x;
      }
    return {low, high};
  }

  /** The frame at or before a time, and how far it is from there to the next, 0 to 1. */
  at(time) {
    let number = 0;
    while (number + 1 < this.times.length && this.times[number + 1] <= time) ++number;
    const next = Math.min(number + 1, this.times.length - 1);
    const length = this.times[next] - this.times[number];
    return {number, next, part: length > 0 ? Math.max(0, (time - this.times[number]) / length) : 0};
  }

  /** Displacements at a time, in metres, into an array. */
  displacements({number, next, part}, into) {
    const a = this.frames[number].displacement, b = this.frames[next].displacement;
    const scale = this.largest_displacement / 32767;
    for (let i = 0; i < into.length; ++i) into[i] = scale * (a[i] + part * (b[i] - a[i]));
  }

  /** Place and turn of a tool at a time. */
  pose(tool, {number, next, part}) {
    const {poses} = this.tools[tool];
    return [0, 1, 2, 3, 4, 5].map((i) => poses[6 * number + i] + part * (poses[6 * next + i] - poses[6 * number + i]));
  }

  /** A field of the triangles at a time, into an array. */
  values(field, {number, next, part}, into) {
    const a = this.frames[number][field], b = this.frames[next][field];
    const [low, high] = this.range[field];
    const scale = (high - low) / 65535;
    for (let i = 0; i < into.length; ++i) into[i] = low + scale * (a[i] + part * (b[i] - a[i]));
  }
}
