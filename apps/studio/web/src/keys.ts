// SPDX-License-Identifier: Apache-2.0
// The keys of the editor; the page's `?` lists them.
import {addAt, deleteChosen, mergeChosen, nudgeChosen, setTerminal, snapChosen, splitChosen, step, timeline} from './contacts';
import {changed, chosenMark, current} from './current';
import {$} from './dom';
import {animate} from './planning';
import {chooseTake} from './takes';
import {seek, toggleLoop, togglePlay} from './transport';

const position = (): number => current.player?.position ?? 0;

function arrow(direction: number, coarse: boolean): void {
  const by = direction * (coarse ? 0.01 : 0.001);
  if (chosenMark()) nudgeChosen(by);
  else seek(position() + by);
}

const keys: Record<string, (event: KeyboardEvent) => void> = {
  ' ': () => void togglePlay(),
  ArrowLeft: (event) => arrow(-1, event.shiftKey),
  ArrowRight: (event) => arrow(1, event.shiftKey),
  a: () => addAt(position()),
  o: snapChosen, s: splitChosen, m: mergeChosen, Delete: deleteChosen, Backspace: deleteChosen,
  t: () => setTerminal(!current.history.present.terminal),
  l: () => void toggleLoop(),
  '+': () => timeline.zoom(0.6, position()), '=': () => timeline.zoom(0.6, position()),
  '-': () => timeline.zoom(1.7, position()), '0': () => timeline.showAll(),
  Escape: () => {
    current.chosen = null;
    changed('marks');
  },
  '?': () => $<HTMLDialogElement>('keys').showModal(),
};

const typing = (target: EventTarget | null): boolean =>
  target instanceof HTMLInputElement && target.type !== 'checkbox' || target instanceof HTMLSelectElement;

export function keyDown(event: KeyboardEvent): void {
  if (typing(event.target) || document.querySelector('dialog[open]') || $('editor').hidden) return;
  const command = event.ctrlKey || event.metaKey;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (command && key === 'z') step(event.shiftKey ? 'redo' : 'undo');
  else if (command && key === 'y') step('redo');
  else if (command && key === 'Enter') void animate();
  else if (command || event.altKey) return;
  else if (key >= '1' && key <= '6' && key.length === 1) chooseTake(Number(key));
  else if (keys[key] && !(key === ' ' && event.target instanceof HTMLButtonElement && event.target.id !== 'play')) keys[key](event);
  else return;
  event.preventDefault();
}
