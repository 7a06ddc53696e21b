// All that was done once more with half the step: the error in time of what one has just done.

import {element} from './dom.js';
import {digits, quantity} from './format.js';

export class Again {
  constructor(say) {
    this.say = say;
    this.button = element('button', {type: 'button', onclick: () => this.press()}, 'Again with half the step');
    this.progress = element('progress', {max: 1, value: 0, hidden: true, 'aria-label': 'Progress of the second run'});
    this.result = element('p', {class: 'note', role: 'status'}, 'Does all that you have done once more with half the step: how far apart both end tells the error in time.');
    this.root = element('section', {class: 'again', 'aria-label': 'Error in time of the session'}, element('div', {class: 'controls'}, this.button, this.progress), this.result);
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

  tell({difference, relative, seconds}) {
    this.result.textContent = `With half the step all vertices end within ${quantity(difference, 'm', 2)} of where they are${Number.isFinite(relative) ? `, ${digits(100 * relative, 2)} % of the largest motion` : ''}: `
      + `the error in time of what you have just done is about as large. The second run took ${quantity(seconds, 's', 2)}.`;
  }
}
