// Rows that grow. Where they would be too many, every other one is left out: the later, the more of them are kept.

const MOST = 3000;

export class Table {
  constructor(names) {
    this.names = names;
    this.clear();
  }

  clear() {
    this.columns = Object.fromEntries(this.names.map((name) => [name, []]));
    this.length = 0;
    this.version = (this.version ?? 0) + 1;
  }

  add(rows) {
    if (rows.length === 0) return;
    for (const row of rows) this.names.forEach((name, c) => this.columns[name].push(row[c]));
    this.length += rows.length;
    ++this.version;
    if (this.length > MOST) this.thin();
  }

  thin() {
    for (const name of this.names) this.columns[name] = this.columns[name].filter((_, row) => row % 2 === 0 || row === this.length - 1);
    this.length = this.columns[this.names[0]].length;
  }

  /** The rows from which on a column is at least this; it rises. */
  from(name, value) {
    const column = this.columns[name];
    let low = 0, high = column.length;
    while (low < high) {
      const middle = low + high >> 1;
      if (column[middle] < value) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}
