// SPDX-License-Identifier: Apache-2.0
// Playing, scrubbing, slow motion, looping.
import {changed, chosenMark, current, whenChanged} from './current';
import {$, button, select, tellError} from './dom';

export function seek(time: number): void {
  current.player?.seek(time);
}

export async function togglePlay(): Promise<void> {
  const {player} = current;
  if (!player) return;
  if (player.playing) player.pause();
  else await player.play().catch(tellError);
  showPlaying();
}

export function pause(): void {
  if (current.player?.playing) current.player.pause();
  showPlaying();
}

function showPlaying(): void {
  const on = current.player?.playing ?? false;
  button('play').classList.toggle('on', on);
  button('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
}

export async function setSpeed(): Promise<void> {
  await current.player?.setSpeed(Number(select('speed').value));
}

/** The part between the contacts around the chosen one or the playhead, again and again; or all again. */
export async function toggleLoop(): Promise<void> {
  const {player} = current;
  if (!player) return;
  const on = !player.loops;
  const {marks} = current.history.present;
  const at = chosenMark()?.start ?? player.position;
  const before = marks.filter((mark) => mark.start <= at + 1e-6).pop();
  const after = marks.find((mark) => mark.start > at + 1e-6);
  const span = {from: Math.max(0, (before?.start ?? 0) - 0.03), to: Math.min(player.duration, (after?.start ?? player.duration) + 0.03)};
  await player.setSpan(on ? span : null);
  changed('loop');
}
whenChanged(['loop'], () => $('loop').setAttribute('aria-pressed', String(current.player?.loops ?? false)));
