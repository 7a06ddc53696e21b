// Colour maps: [position, red, green, blue], as in scripts/render.py.

const RISING = [[0, 0.16, 0.25, 0.55], [0.25, 0.2, 0.55, 0.7], [0.5, 0.75, 0.85, 0.65], [0.75, 0.95, 0.65, 0.3], [1, 0.7, 0.1, 0.15]];
const AROUND = [[0, 0.13, 0.29, 0.6], [0.25, 0.45, 0.65, 0.85], [0.5, 0.9, 0.9, 0.88], [0.75, 0.93, 0.6, 0.42], [1, 0.65, 0.1, 0.15]];
const MATERIALS = [[0, 0.36, 0.55, 0.66], [0.5, 0.85, 0.72, 0.5], [1, 0.62, 0.4, 0.45]];

/** Of errors: least is best. */
export const ERRORS = [[0, 0.1, 0.44, 0.3], [0.25, 0.5, 0.72, 0.5], [0.5, 0.96, 0.96, 0.92], [0.75, 0.98, 0.72, 0.42], [1, 0.68, 0.33, 0.05]];

export const FIELDS = {
  displacement: {title: 'displacement', unit: 'm', map: RISING},
  volume_ratio: {title: 'volume ratio', unit: '', map: AROUND, middle: 1},
  von_mises_stress: {title: 'von Mises stress', unit: 'Pa', map: RISING},
  contact_pressure: {title: 'contact pressure', unit: 'Pa', map: RISING},
  error_in_space: {title: 'error in space', unit: '', map: RISING},
  material: {title: 'material id', unit: '', map: MATERIALS},
};

export function colourAt(map, part) {
  const x = Math.min(1, Math.max(0, part));
  let i = 1;
  while (i < map.length - 1 && map[i][0] < x) ++i;
  const [a, b] = [map[i - 1], map[i]];
  const t = (x - a[0]) / (b[0] - a[0]);
  return [1, 2, 3].map((c) => a[c] + t * (b[c] - a[c]));
}

export function gradient(map) {
  const stops = map.map(([x, ...rgb]) => `rgb(${rgb.map((c) => Math.round(255 * c)).join(' ')}) ${100 * x}%`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

/** The range of colours: as far on both sides of the middle, if the map has one. */
export function colourRange(field, [low, high]) {
  const {middle} = FIELDS[field];
  if (middle !== undefined) {
    const reach = Math.max(Math.abs(low - middle), Math.abs(high - middle), 1e-6);
    return [middle - reach, middle + reach];
  }
  return field === 'material' || high > low ? [low, high] : [low, low + 1e-12 + Math.abs(low)];
}
