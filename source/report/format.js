// Numbers with units, as text.

const PREFIXES = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p']];

/** How much of a unit its prefix stands for, and the unit with it, for numbers up to this size. */
export function prefixed(largest, unit) {
  if (!unit || !(largest > 0) || unit.includes('²')) return [1, unit];
  const [size, prefix] = PREFIXES.find(([size]) => largest >= 0.9999 * size) ?? PREFIXES.at(-1);
  return [size, prefix + unit];
}

/** With so many digits that matter. */
export function digits(value, n = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e7) return value.toLocaleString('en-GB').replaceAll(',', '\u202f');
  if (size >= 1e7 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(n - 1).split('e');
    return `${Number(mantissa)}e${Number(exponent)}`;
  }
  return String(Number(value.toPrecision(n)));
}

/** "3.31 mm" */
export function quantity(value, unit, n = 4) {
  const [size, symbol] = prefixed(Math.abs(value), unit);
  return `${digits(value / size, n)}${symbol ? '\u202f' + symbol : ''}`;
}

/** "1 frame", "2 frames" */
export function count(n, noun) {
  return `${digits(n)} ${noun}${n === 1 ? '' : 's'}`;
}
