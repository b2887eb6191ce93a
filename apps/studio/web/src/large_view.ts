// SPDX-License-Identifier: Apache-2.0
// Pointing at the large picture: contacts on the floor are explained, a click on a face demands it.
import {explain} from './bend';
import {chosenObject, chosenTake, current} from './current';
import {$, showTip} from './dom';
import {job} from './job';
import {demandFace} from './planning';
import {paintTakes} from './takes';

type Point = [number, number];

/** Where an event is in the picture, -1 to 1 each way. */
export function pointOf(event: MouseEvent): Point {
  const box = $('large').getBoundingClientRect();
  return [(2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height];
}

/** The named face of the body there; none where that has no name, or the takes are of another object. */
function faceAt([x, y]: Point): string | null {
  const take = chosenTake();
  if (!take || take.motion.object.name !== current.saved.object) return null;
  const normal = take.scene?.normalAt(x, y);
  if (!normal) return null;
  const faces = Object.entries(chosenObject()?.faces ?? {});
  return faces.find(([, to]) => to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2] > 0.95)?.[0] ?? null;
}

function tipOf(point: Point): string {
  const take = chosenTake();
  const spot = take?.scene?.spotAt(...point) ?? null;
  const contact = spot === null ? undefined : take?.motion.contacts[spot];
  const first = current.saved.plan?.marks[0]?.start ?? 0;
  if (take && contact && spot !== null) return explain(contact, spot, take.motion.bend.cap, first + contact.time);
  const face = job.runs ? null : faceAt(point);
  return face === null || face === current.saved.face ? '' : `Click: ends with ${face} up`;
}

export function wireLargeView(): void {
  const large = $('large');
  const tell = (event: PointerEvent): void => showTip(tipOf(pointOf(event)), event.clientX, event.clientY);
  large.addEventListener('pointermove', tell);
  let down: Point = [0, 0];
  large.addEventListener('pointerdown', (event) => (down = [event.clientX, event.clientY]));
  large.addEventListener('pointerup', (event) => {
    const turned = Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4;
    const face = turned ? null : faceAt(pointOf(event));
    if (face !== null) demandFace(face);
    else if (!turned) tell(event); // a finger does not hover
  });
  large.addEventListener('pointerleave', (event) => event.pointerType === 'touch' || showTip('', 0, 0));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', paintTakes);
}
