// SPDX-License-Identifier: Apache-2.0
// The contacts of a sound and how they are edited. Pure: every edit gives a new list, in order of time.

/** One contact: a click where end = start, else a rattle or a roll. Seconds in the sound. */
export interface Mark {
  readonly id: number;
  readonly start: number;
  readonly end: number;
  /** How sure the detector is, 0 to 1; 1 for what a person has set or touched. */
  readonly confidence: number;
}

/** All that undo brings back. */
export interface Marking {
  readonly marks: readonly Mark[];
  /** Whether the object comes to rest at the last contact. */
  readonly terminal: boolean;
}

/** Contacts closer than this are one, s. */
export const kMinGap = 0.001;

export const isClick = (mark: Mark): boolean => mark.end <= mark.start;

export function nextId(marks: readonly Mark[]): number {
  return marks.reduce((most, mark) => Math.max(most, mark.id), 0) + 1;
}

const clamp = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);

/** Between which times a mark may lie without touching its neighbours. */
function room(marks: readonly Mark[], id: number, duration: number): [number, number] {
  const at = marks.findIndex((mark) => mark.id === id);
  const before = marks[at - 1];
  const after = marks[at + 1];
  return [before ? before.end + kMinGap : 0, after ? after.start - kMinGap : duration];
}

function replaced(marks: readonly Mark[], id: number, change: (mark: Mark) => Mark): Mark[] {
  return marks.map((mark) => (mark.id === id ? change(mark) : mark));
}

/** Moved so that it starts there, as far as its neighbours let it. */
export function moved(marks: readonly Mark[], id: number, start: number, duration: number): Mark[] {
  const [low, high] = room(marks, id, duration);
  return replaced(marks, id, (mark) => {
    const length = mark.end - mark.start;
    const from = clamp(start, low, Math.max(low, high - length));
    return {...mark, start: from, end: from + length, confidence: 1};
  });
}

/** Lengthened or shortened to end there; under 5 ms it is a click. */
export function ended(marks: readonly Mark[], id: number, end: number, duration: number): Mark[] {
  const [, high] = room(marks, id, duration);
  return replaced(marks, id, (mark) => {
    const to = clamp(end, mark.start, high);
    return {...mark, end: to - mark.start < 0.005 ? mark.start : to, confidence: 1};
  });
}

/** With a new click at that time; unchanged where there is a mark already. */
export function added(marks: readonly Mark[], time: number, duration: number): Mark[] {
  const taken = marks.some((mark) => time > mark.start - kMinGap && time < mark.end + kMinGap);
  if (taken || time < 0 || time > duration) return [...marks];
  const mark = {id: nextId(marks), start: time, end: time, confidence: 1};
  return [...marks, mark].sort((a, b) => a.start - b.start);
}

export function removed(marks: readonly Mark[], id: number): Mark[] {
  return marks.filter((mark) => mark.id !== id);
}

/** A rattle in two at that time, or in its middle where the time is not inside. A click stays. */
export function split(marks: readonly Mark[], id: number, time: number): Mark[] {
  const mark = marks.find((one) => one.id === id);
  if (!mark || mark.end - mark.start < 4 * kMinGap) return [...marks];
  const inside = time > mark.start + kMinGap && time < mark.end - kMinGap;
  const at = inside ? time : (mark.start + mark.end) / 2;
  const second = {id: nextId(marks), start: at + kMinGap, end: mark.end, confidence: 1};
  return marks.flatMap((one) => (one.id === id ? [{...one, end: at, confidence: 1}, second] : [one]));
}

/** Joined with the one after it into a rattle from the first's start to the second's end. */
export function mergedWithNext(marks: readonly Mark[], id: number): Mark[] {
  const at = marks.findIndex((mark) => mark.id === id);
  const first = marks[at];
  const second = marks[at + 1];
  if (!first || !second) return [...marks];
  const end = Math.max(second.end, second.start);
  return [...marks.slice(0, at), {...first, end, confidence: 1}, ...marks.slice(at + 2)];
}

/** The marks as an Audacity label track. */
export function labelTrack({marks, terminal}: Marking): string {
  return marks
    .map((mark, i) => {
      const last = i + 1 === marks.length;
      const text = last ? (terminal ? 'terminal' : 'non-terminal') : `c${i + 1}`;
      return `${mark.start.toFixed(6)}\t${mark.end.toFixed(6)}\t${text}\n`;
    })
    .join('');
}

/** What was, is and was undone. */
export class History<T> {
  private past: T[] = [];
  private future: T[] = [];
  private lastKey = '';

  constructor(private now: T) {}

  get present(): T {
    return this.now;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Edits in a row with the same key (that is not empty) are undone together, such as those of one drag. */
  set(value: T, key = ''): void {
    if (key === '' || key !== this.lastKey) {
      this.past.push(this.now);
      if (this.past.length > 500) this.past.shift();
    }
    this.lastKey = key;
    this.future = [];
    this.now = value;
  }
  undo(): void {
    const before = this.past.pop();
    if (before === undefined) return;
    this.future.push(this.now);
    this.now = before;
    this.lastKey = '';
  }
  redo(): void {
    const after = this.future.pop();
    if (after === undefined) return;
    this.past.push(this.now);
    this.now = after;
    this.lastKey = '';
  }
}
