// How long it takes from a command to the picture that shows it: for benchmarks/live.

export class Timing {
  constructor(connection) {
    this.connection = connection;
    this.frames = 0; // that were drawn
  }

  /** Says a command. @return promise of the milliseconds until a frame that knows of it has arrived, and was drawn */
  say(command) {
    return new Promise((resolve) => {
      const begun = performance.now();
      this.waiting = {number: this.connection.say(command), resolve, begun};
    });
  }

  arrived(frame) {
    const {waiting} = this;
    if (waiting && waiting.arrived === undefined && new DataView(frame).getUint32(20, true) >= waiting.number) waiting.arrived = performance.now() - waiting.begun;
  }

  /** A frame was drawn; with the next one it has left for the screen. */
  drawn(command) {
    ++this.frames;
    const {waiting} = this;
    if (!waiting || command < waiting.number) return;
    this.waiting = null;
    requestAnimationFrame(() => waiting.resolve([waiting.arrived, performance.now() - waiting.begun]));
  }
}
