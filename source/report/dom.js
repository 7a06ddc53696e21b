// Elements of the page. Text of a run only ever comes in as text.

/** element('p', {class: 'note'}, 'text', child, ...) */
export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

const SVG = 'http://www.w3.org/2000/svg';

export function drawing(attributes, ...paths) {
  const make = (tag, values) => {
    const node = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(values)) node.setAttribute(name, value);
    return node;
  };
  const node = make('svg', attributes);
  for (const [tag, values] of paths) node.append(make(tag, values));
  return node;
}

export function icon(path) {
  return drawing({viewBox: '0 0 24 24', width: 20, height: 20, 'aria-hidden': 'true'}, ['path', {d: path, fill: 'currentColor'}]);
}

/** A labelled choice of [value, text]. */
export function choice(label, options, value, changed) {
  const select = element('select', {onchange: () => changed(select.value)},
    options.map(([key, text]) => element('option', {value: key, selected: String(key) === String(value)}, text)));
  return element('label', {class: 'choice'}, element('span', {}, label), select);
}

/** A button that is on or off. */
export function toggle(text, title, on, changed) {
  const button = element('button', {type: 'button', class: 'toggle', title, 'aria-pressed': String(on)}, text);
  button.addEventListener('click', () => {
    const pressed = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(pressed));
    changed(pressed);
  });
  return button;
}

const themed = [];
let colours = new Map();

/** @param changed is called when the page goes from light to dark or back */
export function onThemeChange(changed) {
  themed.push(changed);
}

matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  colours = new Map();
  themed.forEach((changed) => changed());
});

/** A colour of the style sheet; asked for often, and slow to find. */
export function styleColour(name) {
  if (!colours.has(name)) colours.set(name, getComputedStyle(document.documentElement).getPropertyValue(name).trim());
  return colours.get(name);
}
