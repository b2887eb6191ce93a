// SPDX-License-Identifier: Apache-2.0
// What is drawn with each frame of the browser: all at the moment that is heard then.
import {timeline} from './contacts';
import {chosenTake, current} from './current';
import {$} from './dom';
import {job} from './job';
import {placeGrip} from './landing';
import {controls, stage, theme} from './takes';
import {Touches} from './touches';
import {seek} from './transport';

let turn = 0;
let drawn = '';
let drawnStill = false;
let lastMoved = 0;
const touches = new Touches();
const idleStart = performance.now();

export function frame(): void {
  requestAnimationFrame(frame);
  const {player, saved, session} = current;
  if (!player) return;
  const time = player.position;
  timeline.setPosition(time);
  $('clock').textContent = `${time.toFixed(3)} s`;
  const scene = chosenTake()?.scene;
  if (!scene || !stage) return;
  ++turn;
  // While something is planned, the processor is the planner's.
  const small = !job.runs && turn % 4 === 0 && drawSmall(time);
  const shown = touches.shown(time, contactTimes());
  scene.setTime(shown, controls ?? undefined);
  Object.assign(measured, {heard: time, shown});
  controls?.update();
  const landing = placeGrip();
  const now = `${session?.session} ${saved.plan?.number} ${saved.take} ${shown} ${scene.camera.position.toArray()} ${innerWidth} ${innerHeight} ${theme} ${landing}`;
  if (now !== drawn) lastMoved = performance.now();
  const still = performance.now() - lastMoved > 250;
  if (now === drawn && still === drawnStill && !small) return;
  drawn = now;
  drawnStill = still;
  stage.drawLarge(scene, still);
}

/** One of the small pictures at a time: they may come late, the large one may not. Whether one was drawn. */
function drawSmall(time: number): boolean {
  const {player, takes} = current;
  const take = takes[(turn / 4) % takes.length];
  if (!take?.scene || !stage || !player) return false;
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  take.scene.setTime(player.playing || still ? time : ((performance.now() - idleStart) / 1000) % (player.duration + 0.4));
  stage.drawSmall(take.scene, take.canvas);
  return true;
}

/** When the chosen take touches, s in the sound. */
function contactTimes(): number[] {
  const first = current.saved.plan?.marks[0]?.start ?? 0;
  return chosenTake()?.motion.contacts.map((contact) => first + contact.time) ?? [];
}

/** For measuring and tests: what is heard, and what is drawn. */
export const measured = {
  /** Of the last frame, s in the sound: what was heard, and the moment that it shows. */
  heard: 0,
  shown: 0,
  get time(): number { return current.player?.position ?? 0; },
  get contacts(): number[] { return contactTimes(); },
  seek,
  lowestAt(time: number): number {
    const scene = chosenTake()?.scene;
    scene?.setTime(time);
    return scene?.lowestPoint() ?? NaN;
  },
};
