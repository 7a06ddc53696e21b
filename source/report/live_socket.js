// What the page and the program of a live session say to each other.

import {readFrame} from './live_surface.js';

const CREDITS = 2; // frames that may be under way
const AGAIN = 1000; // ms from a lost connection to the next attempt
const REMEMBERED = 500; // commands that may still be refused

export class Connection {
  /**
   * @param shape {vertices, tools} of the frames
   * @param told  functions: changed(status, reason), frame(), and one for each kind of message
   */
  constructor(token, shape, told) {
    Object.assign(this, {token, shape, told});
    this.number = 0;
    this.sent = new Map();
    this.later = new Map();
    this.frame = null;
    this.owed = 0;
    // A page that is kept for the way back in the history must leave the session to others.
    addEventListener('pagehide', () => {
      this.away = true;
      this.socket?.close();
    });
    addEventListener('pageshow', ({persisted}) => {
      this.away = false;
      if (persisted) this.open();
    });
  }

  address(path) {
    return `${path}?token=${encodeURIComponent(this.token)}`;
  }

  open() {
    let wasOpen = false;
    this.socket = new WebSocket(`ws://${location.host}${this.address('/socket')}`);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onmessage = ({data}) => this.take(data);
    this.socket.onopen = () => {
      wasOpen = true;
      this.frame = null;
      this.owed = 0;
      this.later.clear();
      for (let i = 0; i < CREDITS; ++i) this.socket.send('a');
      this.told.changed('open');
    };
    this.socket.onclose = ({reason}) => {
      if (this.over || this.away) return;
      if (wasOpen) this.told.changed('lost', reason);
      else this.explain();
      setTimeout(() => this.open(), AGAIN);
    };
  }

  /** Why it does not open: no program, another session, or another page. */
  async explain() {
    const stop = new AbortController();
    try {
      const {status} = await fetch(this.address('/surface'), {signal: stop.signal});
      stop.abort();
      this.told.changed(status === 200 ? 'taken' : 'foreign');
    } catch {
      this.told.changed('lost');
    }
  }

  get isOpen() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  take(data) {
    if (data instanceof ArrayBuffer) {
      ++this.owed;
      this.frame = data;
      this.told.frame();
      return;
    }
    const message = JSON.parse(data);
    if (message.kind === 'refused') this.refuse(message);
    if (message.kind === 'ended') this.over = true;
    this.told[message.kind]?.(message);
  }

  refuse(message) {
    const refused = this.sent.get(message.number);
    this.sent.delete(message.number);
    message.answered = Boolean(refused);
    refused?.(message);
  }

  /** The newest frame, once. One of another body ends the session. */
  takeFrame() {
    const {frame} = this;
    this.frame = null;
    if (!frame || this.over) return null;
    try {
      return readFrame(frame, this.shape);
    } catch (error) {
      this.over = true;
      this.socket.close();
      this.told.ended(error);
      return null;
    }
  }

  /** That the frame was drawn, and those before it were passed over: there is room for as many. */
  drawn() {
    for (; this.owed > 0; --this.owed) if (this.isOpen) this.socket.send('a');
  }

  /** Says a command; refused is called with the message if the program does not take it. @return its number, 0 if nobody hears it */
  say(command, refused) {
    if (!this.isOpen) return 0;
    this.flush();
    ++this.number;
    if (refused) this.sent.set(this.number, refused);
    if (this.sent.size > REMEMBERED) this.sent.delete(this.sent.keys().next().value);
    this.socket.send(`${this.number} ${command}`);
    return this.number;
  }

  /** Says it with the next picture; of those with the same key the last one alone. */
  sayLater(key, command) {
    if (this.later.size === 0) requestAnimationFrame(() => this.flush());
    this.later.set(key, command);
  }

  flush() {
    const commands = [...this.later.values()];
    this.later.clear();
    commands.forEach((command) => this.say(command));
  }
}
