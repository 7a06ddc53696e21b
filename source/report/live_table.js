// Rows that grow, each with its time. Where they would be too many, older ones are left out.

const MOST = 3000, NEWEST = 1000, OLDER = 1000;

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

  /** The newest row, by its columns. */
  last() {
    return Object.fromEntries(this.names.map((name) => [name, this.columns[name][this.length - 1]]));
  }

  /** The newest rows stay; of those before only some, evenly spread over time. */
  thin() {
    const {time} = this.columns, cut = this.length - NEWEST, apart = (time[cut] - time[0]) / OLDER, kept = [];
    for (let row = 0; row < this.length; ++row)
      if (row === 0 || row >= cut || time[row] >= time[kept.at(-1)] + 0.999 * apart) kept.push(row);
    for (const name of this.names) this.columns[name] = kept.map((row) => this.columns[name][row]);
    this.length = kept.length;
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
