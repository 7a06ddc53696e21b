// All that was done once more with half the step: the error in time of what one has just done.

import {axis, lineStyle, mount, unmount} from './charts.js';
import {element} from './dom.js';
import {digits, prefixed, quantity} from './format.js';

export class Again {
  constructor(say) {
    this.say = say;
    this.button = element('button', {type: 'button', onclick: () => this.press()}, 'Again with half the step');
    this.progress = element('progress', {max: 1, value: 0, hidden: true, 'aria-label': 'Progress of the second run'});
    this.result = element('p', {class: 'note', role: 'status'}, 'Does all that you have done once more with half the step: how far apart both end tells the error in time.');
    this.holder = element('div', {class: 'chart', hidden: true});
    this.root = element('section', {class: 'again', 'aria-label': 'Error in time of the session'}, element('div', {class: 'controls'}, this.button, this.progress), this.result, this.holder);
  }

  press() {
    this.say(this.running ? 'stop again' : 'again', ({message}) => this.take({status: 'failed', message}));
  }

  take(message) {
    const {status, part = 0} = message;
    this.running = status === 'running';
    this.button.textContent = this.running ? 'Stop the second run' : 'Again with half the step';
    this.progress.hidden = !this.running;
    this.progress.value = part;
    if (this.running) this.result.textContent = `The second run has done ${Math.round(100 * part)} %.`;
    else if (status === 'failed') this.result.textContent = `The second run tells nothing: ${message.message}`;
    else this.tell(message);
  }

  tell({difference, relative, seconds, probes = []}) {
    this.result.textContent = `With half the step all vertices end within ${quantity(difference, 'm', 2)} of where they are${Number.isFinite(relative) ? `, ${digits(100 * relative, 2)} % of the largest motion` : ''}: `
      + `the error in time of what you have just done is about as large. The second run took ${quantity(seconds, 's', 2)}.`;
    if (this.chart) unmount(this.chart);
    this.chart = null;
    this.holder.hidden = probes.length < 2;
    if (this.holder.hidden) return;
    const [times, differences] = [0, 1].map((c) => probes.map((row) => row[c]));
    const [size, symbol] = prefixed(differences.reduce((most, x) => Math.max(most, Math.abs(x)), 0), 'm');
    const texts = (_, ticks) => ticks.map((tick) => digits(tick, 6));
    this.chart = mount({
      height: 150, scales: {x: {time: false}}, cursor: {drag: {x: false, y: false}}, padding: [8, 12, 0, 0],
      axes: [axis('time in s', {size: 34, values: texts}), axis(null, {values: texts, size: 56})],
      series: [{label: 'time'}, {label: `largest difference of the probes in ${symbol}`, value: (_, x) => digits(x), width: 1.6, points: {show: false}, ...lineStyle(0)}],
    }, [times, differences.map((x) => x / size)], this.holder);
  }

  clear() {
    if (!this.running) this.holder.hidden = true;
  }
}
