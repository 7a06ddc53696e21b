// Time: play, stop, go from frame to frame. Those who want to know are told.

import {choice, element, icon} from './dom.js';
import {digits, prefixed} from './format.js';

const PLAY = 'M7 4.5v15l13-7.5z', PAUSE = 'M6 4.5h4.5v15H6zM13.5 4.5H18v15h-4.5z';
const BACK = 'M6 5h2.5v14H6zM19 5v14L9.5 12z', ON = 'M15.5 5H18v14h-2.5zM5 5l9.5 7L5 19z';

export class Player {
  /** @param times of the frames, ascending  @param changed is called with each new time */
  constructor(times, stationary, changed) {
    this.times = times;
    this.stationary = stationary;
    this.changed = changed;
    [this.first, this.last] = [times[0], times.at(-1)];
    this.time = this.first;
    this.seconds = 8;
    this.playing = false;
    this.untouched = true;
    [this.unitSize, this.unit] = stationary ? [1, ''] : prefixed(this.last, 's');
    const length = (this.last - this.first) / this.unitSize;
    this.decimals = length > 0 ? Math.min(6, Math.max(0, 3 - Math.floor(Math.log10(length)))) : 3;
    this.root = this.makeControls();
    document.addEventListener('keydown', (event) => this.key(event));
  }

  makeControls() {
    const button = (title, path, action) => element('button', {type: 'button', class: 'icon', title, 'aria-label': title, onclick: action}, icon(path));
    this.playButton = button('Play (space)', PLAY, () => this.toggle());
    this.slider = element('input', {type: 'range', min: 0, max: 1000, step: 1, value: 0, 'aria-label': this.stationary ? 'Load factor' : 'Time'});
    this.slider.addEventListener('input', () => {
      this.pause();
      this.set(this.first + this.slider.value / 1000 * (this.last - this.first));
    });
    this.label = element('output', {class: 'time'});
    const speeds = [2, 4, 8, 16, 32].map((seconds) => [seconds, `in ${seconds} s`]);
    const duration = this.last - this.first;
    if (!this.stationary && duration >= 0.4 && duration <= 120) speeds.push([duration, 'in real time']);
    return element('div', {class: 'player', role: 'group', 'aria-label': 'Player'},
      button('Frame before (←)', BACK, () => this.step(-1)), this.playButton, button('Next frame (→)', ON, () => this.step(1)),
      this.slider, this.label, choice('Play', speeds, 8, (seconds) => { this.seconds = Number(seconds); }));
  }

  /** Keys of the whole page, where nothing else wants them. */
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest('input, select, textarea')) return;
    const actions = {ArrowLeft: () => this.step(-1), ArrowRight: () => this.step(1), Home: () => this.jump(this.first), End: () => this.jump(this.last)};
    if (event.key === ' ' && !event.target.closest('button, summary, a')) this.toggle();
    else if (actions[event.key]) actions[event.key]();
    else return;
    event.preventDefault();
  }

  set(time) {
    this.time = Math.min(this.last, Math.max(this.first, time));
    const length = this.last - this.first;
    this.slider.value = length > 0 ? 1000 * (this.time - this.first) / length : 0;
    const frame = this.times.findLastIndex((t) => t <= this.time * (1 + 1e-12)) + 1;
    const shown = (this.time / this.unitSize).toFixed(this.decimals);
    this.label.textContent = `${this.stationary ? 'load ' : ''}${shown}${this.unit ? '\u202f' + this.unit : ''} · frame ${frame}/${digits(this.times.length)}`;
    this.slider.setAttribute('aria-valuetext', this.label.textContent);
    this.changed(this.time);
  }

  jump(time) {
    this.untouched = false;
    this.pause();
    this.set(time);
  }

  step(direction) {
    const small = 1e-9 * (this.last - this.first);
    const next = direction > 0 ? this.times.find((t) => t > this.time + small) : this.times.findLast((t) => t < this.time - small);
    this.jump(next ?? this.time);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  show(playing) {
    this.playing = playing;
    const title = playing ? 'Pause (space)' : 'Play (space)';
    this.playButton.replaceChildren(icon(playing ? PAUSE : PLAY));
    this.playButton.title = title;
    this.playButton.setAttribute('aria-label', title);
  }

  pause() {
    this.show(false);
  }

  play() {
    if (this.untouched || this.time >= this.last) this.set(this.first);
    this.untouched = false;
    this.show(true);
    let before = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      const time = this.time + (now - before) / 1000 / this.seconds * (this.last - this.first);
      before = now;
      this.set(time);
      if (this.time >= this.last) this.pause();
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
}
