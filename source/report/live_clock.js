// Time in a live session: run, pause, single steps, from the start again, speed.

import {choice, element, icon} from './dom.js';
import {digits, prefixed} from './format.js';

const PLAY = 'M7 4.5v15l13-7.5z', PAUSE = 'M6 4.5h4.5v15H6zM13.5 4.5H18v15h-4.5z', STEP = 'M15.5 5H18v14h-2.5zM5 5l9.5 7L5 19z';
const SPEEDS = [[0.1, '× 0.1'], [0.25, '× 0.25'], [0.5, '× 0.5'], [1, '× 1'], [2, '× 2'], [10, '× 10'], [0, 'as fast as it can']];

/** With as many decimals as its unit lets one read while it runs. */
function timeText(time) {
  const [size, symbol] = time >= 1 || time === 0 ? [1, 's'] : prefixed(time, 's');
  return `${(time / size).toFixed(size === 1 ? 3 : 1)}\u202f${symbol}`;
}

export class Clock {
  /** @param say is called with a command */
  constructor(say, speed) {
    this.say = say;
    const button = (title, path, action) => element('button', {type: 'button', class: 'icon', title, 'aria-label': title, onclick: action}, icon(path));
    this.playButton = button('Run (space)', PLAY, () => this.toggle());
    this.stepButton = button('Single step (s)', STEP, () => say('step'));
    this.resetButton = element('button', {type: 'button', class: 'reset', title: 'From the start again: the first state (Shift+R)', onclick: () => say('reset')}, 'Start again');
    this.speed = choice('Speed', SPEEDS.some(([value]) => value === speed) ? SPEEDS : [[speed, `× ${digits(speed)}`], ...SPEEDS], speed, (value) => say(`speed ${value}`));
    this.time = element('output', {class: 'time', 'aria-label': 'Time and step'});
    this.rate = element('span', {class: 'rate'});
    this.root = element('div', {class: 'player live', role: 'group', 'aria-label': 'Time'},
      this.playButton, this.stepButton, this.time, this.speed, this.resetButton, this.rate);
    this.showRunning(false);
  }

  showRunning(running) {
    this.running = running;
    const title = running ? 'Pause (space)' : 'Run (space)';
    this.playButton.replaceChildren(icon(running ? PAUSE : PLAY));
    this.playButton.title = title;
    this.playButton.setAttribute('aria-label', title);
  }

  showSpeed(speed) {
    const select = this.speed.querySelector('select');
    if (document.activeElement !== select) select.value = String(speed);
    this.wanted = speed;
  }

  show({time, step, running, slow, realTime, stepsPerSecond, stepMilliseconds}) {
    this.time.textContent = `${timeText(time)} · step ${digits(step)}`;
    const rates = [`${digits(stepMilliseconds, 2)}\u202fms a step`];
    if (running) rates.unshift(`× ${digits(realTime, 2)} of real time${slow ? ', slower than wanted' : ''}`, `${digits(stepsPerSecond, 3)} steps/s`);
    const text = rates.join(' · '), now = performance.now();
    this.rate.classList.toggle('slow', running && slow);
    if (now - (this.told ?? 0) < 300 && running === this.toldRunning) return;
    [this.told, this.toldRunning] = [now, running];
    this.rate.textContent = text;
  }

  toggle() {
    if (this.say(this.running ? 'pause' : 'run')) this.showRunning(!this.running);
  }
}
