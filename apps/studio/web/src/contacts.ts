// SPDX-License-Identifier: Apache-2.0
// The contacts over the sound: shown, edited, as labels from and to a file.
import * as api from './api';
import {bendColour, contactsOfMarks, explain} from './bend';
import {changed, chosenMark, chosenTake, current, save, stale, stem, whenChanged} from './current';
import {$, button, downloadText, input, showTip, tellError, toast} from './dom';
import {added, ended, labelTrack, mergedWithNext, moved, nextId, removed, split, type Mark} from './marks';
import {nearestOnset} from './signal';
import {Timeline, type Look} from './timeline';
import {seek} from './transport';

const durationOf = (): number => current.wave?.duration ?? 0;

export const timeline = new Timeline($('track'), {
  choose(id) {
    if (current.chosen === id) return;
    current.chosen = id;
    changed('marks');
  },
  move(id, start, free) {
    const attack = free || !current.wave ? null : nearestOnset(current.wave, start, timeline.reach(7));
    edit(moved(current.history.present.marks, id, attack ?? start, durationOf()), `drag ${id}`);
  },
  end(id, end) {
    edit(ended(current.history.present.marks, id, end, durationOf()), `end ${id}`);
  },
  add: addAt,
  seek,
  hover(id, x, y) {
    showTip(id === null ? '' : tipOf(id), x, y);
  },
});
whenChanged(['marks', 'takes'], show);
whenChanged(['loop'], () => timeline.setLoop(current.player?.loops ? current.player.span : null));

// ---- editing -------------------------------------------------------------------------------------

function edit(marks: Mark[], key = ''): void {
  current.history.set({...current.history.present, marks}, key);
  changed('marks');
  save();
}

export function addAt(time: number): void {
  const before = current.history.present.marks;
  const attack = current.wave ? nearestOnset(current.wave, time, Math.min(0.01, timeline.reach(10))) : null;
  const marks = added(before, attack ?? time, durationOf());
  if (marks.length === before.length) return toast('There is a contact already.');
  current.chosen = nextId(before);
  edit(marks);
  timeline.focusMark(current.chosen);
}

function onChosen(change: (marks: readonly Mark[], mark: Mark) => Mark[], key = ''): void {
  const mark = chosenMark();
  if (!mark) return toast('Choose a contact first: click it, or press Tab.');
  edit(change(current.history.present.marks, mark), key);
  if (chosenMark()) timeline.focusMark(mark.id);
}

/** @param by s */
export const nudgeChosen = (by: number): void =>
  onChosen((marks, mark) => moved(marks, mark.id, mark.start + by, durationOf()), `nudge ${current.chosen}`);
export const snapChosen = (): void => onChosen((marks, mark) => {
  const attack = current.wave ? nearestOnset(current.wave, mark.start) : null;
  if (attack === null) toast('No attack within 20 ms.');
  return moved(marks, mark.id, attack ?? mark.start, durationOf());
});
export const splitChosen = (): void => onChosen((marks, mark) => split(marks, mark.id, current.player?.position ?? 0));
export const mergeChosen = (): void => onChosen((marks, mark) => mergedWithNext(marks, mark.id));
export const deleteChosen = (): void => onChosen((marks, mark) => {
  const at = marks.indexOf(mark);
  current.chosen = (marks[at + 1] ?? marks[at - 1])?.id ?? null;
  return removed(marks, mark.id);
});

export function setTerminal(terminal: boolean): void {
  current.history.set({...current.history.present, terminal});
  changed('marks');
  save();
}

export function step(change: 'undo' | 'redo'): void {
  current.history[change]();
  changed('marks');
  save();
}

// ---- showing -------------------------------------------------------------------------------------

/** How each mark is met by the chosen take, where that was made for these marks. */
function looksOf(marks: readonly Mark[]): Map<number, Look> {
  const looks = new Map<number, Look>();
  const motion = chosenTake()?.motion;
  if (!motion || stale()) return looks;
  const met = contactsOfMarks(marks, motion);
  marks.forEach((mark, at) => {
    const contact = motion.contacts[met.get(mark.id) ?? -1];
    if (!contact) return;
    looks.set(mark.id, {tone: bendColour(contact.bend / motion.bend.cap), note: explain(contact, at, motion.bend.cap, mark.start)});
  });
  return looks;
}

function show(): void {
  const {history} = current;
  const {marks, terminal} = history.present;
  timeline.setMarks(history.present, current.chosen, looksOf(marks));
  input('terminal').checked = terminal;
  button('undo').disabled = !history.canUndo;
  button('redo').disabled = !history.canRedo;
  const mark = chosenMark();
  const at = mark ? marks.indexOf(mark) : -1;
  for (const id of ['snap', 'delete']) button(id).disabled = !mark;
  button('split').disabled = !mark || mark.end <= mark.start;
  button('merge').disabled = !mark || at + 1 === marks.length;
  $('mark-info').textContent = mark
    ? `${at + 1}: ${mark.start.toFixed(4)} s${mark.end > mark.start ? ` – ${mark.end.toFixed(3)} s` : ''}`
    : `${marks.length} contact${marks.length === 1 ? '' : 's'}`;
}

function tipOf(id: number): string {
  const {marks} = current.history.present;
  const at = marks.findIndex((mark) => mark.id === id);
  const mark = marks[at];
  if (!mark) return '';
  const sure = mark.confidence < 1 ? `\n${Math.round(100 * mark.confidence)} % sure that something touches here` : '';
  return looksOf(marks).get(id)?.note ?? `Contact ${at + 1} at ${mark.start.toFixed(4)} s${sure}`;
}

// ---- labels --------------------------------------------------------------------------------------

export const saveLabels = (): void => downloadText(`${stem()}.txt`, labelTrack(current.history.present));

export async function loadLabels(file: Blob): Promise<void> {
  try {
    const {marks, terminal} = await api.readLabels(await file.text());
    const sorted = [...marks].sort((a, b) => a.start - b.start);
    current.history.set({marks: sorted.map((mark, i) => ({...mark, id: i + 1, confidence: 1})), terminal});
    current.chosen = null;
    changed('marks');
    save();
  } catch (error) {
    tellError(error);
  }
}
