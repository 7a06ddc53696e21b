// Entries of the scene that may be changed while it runs: a widget for each.

import {element} from './dom.js';

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const BETWEEN = /greater than (\S+) and less than (\S+)/;
const PACE = 150; // ms between two values of a slider that is dragged
const LONG = 10; // letters of a number that is shown with six digits

/** What one changes most: groups of entries, and what they are called where their section is not told. */
const FIRST = [
  [['Material/Young modulus'], ['Material/Poisson ratio'], ['Material/Lame lambda'], ['Material/Lame mu'], ['Material/Density'], ['Material/Mass per vertex'], ['Corotation/Rotation']],
  [['Loads/Gravity'], ['Loads/Pressure']],
  [['Damping/Mass factor', 'Damping by mass'], ['Damping/Stiffness factor', 'Damping by stiffness'], ['Damping/Viscous', 'Damping by vertex']],
  [['Time/Step', 'Time step'], ['Time/Relative tolerance'], ['Time/Method', 'Method in time']],
];
const LAME = ['Material/Lame lambda', 'Material/Lame mu'], MODULI = ['Material/Young modulus', 'Material/Poisson ratio'];

/** Those of this scene: constants that it uses, loads that there are. */
function firstOnes(list) {
  const value = Object.fromEntries(list.map(({entry, value: text}) => [entry, text]));
  const lame = value['Material/Elastic constants'] === 'Lame';
  const perVertex = Number(value['Material/Mass per vertex']) > 0;
  const left = new Set([...(lame ? MODULI : LAME), perVertex ? 'Material/Density' : 'Material/Mass per vertex',
    ...['Loads/Pressure', 'Damping/Viscous'].filter((entry) => !value[entry] || Number(value[entry]) === 0)]);
  const frictions = list.map(({entry}) => entry).filter((entry) => entry.endsWith('/Friction'))
    .map((entry) => [entry, entry.startsWith('Tool ') ? `Friction of ${entry.slice(5, entry.indexOf('/'))}` : 'Friction of bodies']);
  return [...FIRST, frictions].map((group) => group.filter(([entry]) => entry in value && !left.has(entry))).filter((group) => group.length > 0);
}

const isNumber = (text) => NUMBER.test(text.trim());

/** Whether two texts are the same numbers, or the same. */
function same(a, b) {
  const [p, q] = [a, b].map((text) => text.split(',').map((part) => part.trim()));
  return p.length === q.length && p.every((part, i) => part === q[i] || (isNumber(part) && Number(part) === Number(q[i])));
}

/** What values a slider has: even between two bounds, or by factors from a tenth to ten times; null where neither makes sense. */
function sliderScale({value, range}) {
  const bounds = range.match(BETWEEN)?.slice(1).map(Number);
  if (bounds?.every(Number.isFinite)) {
    const [low, high] = bounds, step = (high - low) / 200;
    return {min: low + step, max: high - step, step: step / 10, toValue: (x) => x, toSlider: (x) => x};
  }
  if (Number(value) === 0) return null;
  let base = Number(value);
  return {min: -1, max: 1, step: 0.01, toValue: (x) => base * 10 ** x,
    toSlider: (x) => {
      if (x === 0 || x / base < 0) return 0;
      if (Math.abs(Math.log10(x / base)) > 1.001) base = x;
      return Math.log10(x / base);
    }};
}

/** One entry. What is typed stays until it is taken, or until Escape brings back the session's value. */
class Widget {
  /** @param say (text, refused) gives the number of the command, 0 if nobody hears it  @param label what it is called here */
  constructor(description, say, label) {
    Object.assign(this, description);
    [this.section, this.name] = [description.entry.slice(0, description.entry.indexOf('/')), description.entry.slice(description.entry.indexOf('/') + 1)];
    this.say = say;
    this.id = `entry-${description.entry.replaceAll(/\W+/g, '-')}`;
    this.message = element('p', {class: 'entry-message', role: 'alert', hidden: true, id: `${this.id}-message`});
    this.fields = this.makeFields();
    this.slider = this.makeSlider();
    const help = element('p', {class: 'note', hidden: true, id: `${this.id}-help`}, `${this.meaning}${this.range ? ` Right is ${this.range}.` : ''}`);
    const more = element('button', {type: 'button', class: 'help', 'aria-expanded': 'false', 'aria-controls': help.id, 'aria-label': `What ${this.name} means`, title: this.meaning}, '?');
    more.addEventListener('click', () => {
      help.hidden = !help.hidden;
      more.setAttribute('aria-expanded', String(!help.hidden));
    });
    const unit = element('span', {class: 'unit'}, this.unit && this.unit !== 'none' ? this.unit.replaceAll('^2', '²').replaceAll('^3', '³') : '');
    this.root = element('div', {class: 'entry', role: 'group', 'aria-label': this.name},
      element('label', {for: this.id, title: `${this.entry}: ${this.meaning}`}, label ?? this.name), element('span', {class: 'fields'}, this.fields, unit), this.slider ?? element('span', {class: 'no-slider'}), more, this.message, help);
    this.show(this.value);
  }

  makeFields() {
    if (this.choices) {
      const select = element('select', {id: this.id}, this.choices.map((text) => element('option', {value: text}, text)));
      select.addEventListener('change', () => this.commit());
      return [select];
    }
    const parts = this.value.split(',');
    this.vector = parts.length === 3 && parts.every(isNumber);
    return (this.vector ? ['x', 'y', 'z'] : ['']).map((d, i) => {
      const field = element('input', {type: 'text', id: i === 0 ? this.id : `${this.id}-${d}`, class: this.vector ? 'number' : isNumber(this.value) ? 'number' : 'words', autocomplete: 'off', spellcheck: 'false',
        inputmode: isNumber(this.value) || this.vector ? 'decimal' : 'text', 'aria-label': `${this.name}${d && ` along ${d}`}`, 'aria-describedby': this.message.id, title: d && `along ${d}`});
      field.addEventListener('input', () => { this.edited = true; });
      field.addEventListener('change', () => this.commit());
      field.addEventListener('keydown', (event) => this.key(event));
      return field;
    });
  }

  makeSlider() {
    this.scale = !this.choices && !this.vector && isNumber(this.value) ? sliderScale(this) : null;
    if (!this.scale) return null;
    const {min, max, step} = this.scale;
    const slider = element('input', {type: 'range', min, max, step, 'aria-label': `${this.name}, slider`});
    slider.addEventListener('input', () => {
      this.fields[0].value = String(Number(this.scale.toValue(Number(slider.value)).toPrecision(3)));
      this.edited = true;
      this.sliding ??= setTimeout(() => this.commit(), PACE);
    });
    slider.addEventListener('change', () => this.commit());
    return slider;
  }

  key(event) {
    if (event.key === 'Enter') this.commit();
    if (event.key !== 'Escape') return;
    event.stopPropagation();
    this.back();
  }

  get text() {
    return this.fields.map((field) => field.value.trim()).join(', ');
  }

  commit() {
    clearTimeout(this.sliding);
    this.sliding = null;
    const {text} = this;
    if (text === this.said) return;
    if (text === this.shown && !this.said) {
      this.back();
      return;
    }
    this.waiting = this.said ? this.waiting + 1 : 1;
    this.said = text;
    this.number = this.say(text, ({number, message}) => this.refuse(number, message));
    if (this.number === 0) this.refuse(0, 'The program does not hear: the connection is lost.');
  }

  /** An answer to an older command tells nothing of what stands there now. */
  refuse(number, message) {
    if (this.number !== number) return;
    this.said = null;
    this.refused = true;
    this.message.textContent = `${message} Escape brings back ${this.value || 'what was there'}.`;
    this.message.hidden = false;
    this.fields.forEach((field) => field.setAttribute('aria-invalid', 'true'));
  }

  /** To the session's value. */
  back() {
    this.said = null;
    this.edited = false;
    this.show(this.value);
  }

  show(value) {
    const parts = this.vector ? value.split(',').map((part) => part.trim()) : [value];
    this.fields.forEach((field, i) => {
      const text = parts[i] ?? '';
      field.value = !this.choices && isNumber(text) && text.length > LONG ? String(Number(Number(text).toPrecision(6))) : text;
    });
    this.shown = this.text;
    this.refused = false;
    this.message.hidden = true;
    this.fields.forEach((field) => field.removeAttribute('aria-invalid'));
    if (this.slider && document.activeElement !== this.slider) this.slider.value = this.scale.toSlider(Number(value));
    if (this.slider) this.slider.setAttribute('aria-valuetext', `${value} ${this.unit ?? ''}`);
  }

  /** The session's value, and the last command that it knows. What is typed or waits for an answer stays. */
  take(value, command) {
    const changed = value !== this.value;
    this.value = value;
    if (this.said) {
      if (!(changed && (this.waiting === 1 || same(value, this.said))) && !(command >= this.number)) return;
      const typedOn = this.text !== this.said;
      this.said = null;
      if (typedOn) return;
      this.edited = false;
    }
    if (this.edited || this.refused) return;
    if (changed || value !== this.shown) this.show(value);
  }
}

export class Entries {
  constructor(list, connection) {
    const first = firstOnes(list), names = new Map(first.flat());
    this.widgets = list.map((entry) => new Widget(entry, (text, refused) => connection.say(`set ${entry.entry}=${text}`, refused), names.get(entry.entry)));
    const widgetOf = new Map(this.widgets.map((widget) => [widget.entry, widget.root]));
    const others = this.widgets.filter(({entry}) => !names.has(entry)), sections = [...new Set(others.map(({section}) => section))];
    const more = others.length === 0 ? null : element('details', {class: 'more'}, element('summary', {}, `More: ${sections.join(', ')}`),
      sections.map((section) => element('div', {class: 'group'}, element('h3', {}, section), others.filter((widget) => widget.section === section).map(({root}) => root))));
    this.root = list.length === 0 ? null : element('section', {class: 'entries', 'aria-label': 'Change the scene'}, element('h2', {}, 'Change the scene'),
      first.map((group) => element('div', {class: 'group'}, group.map(([entry]) => widgetOf.get(entry)))), more);
  }

  take(values, command) {
    for (const widget of this.widgets) if (values[widget.entry] !== undefined) widget.take(values[widget.entry], command);
  }
}
