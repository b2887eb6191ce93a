// SPDX-License-Identifier: Apache-2.0
// Where the body lands, dragged on the floor of the large view, by pointer or by keys.
import type {MotionContact} from './api';
import {chosenTake, current, whenChanged, type Take} from './current';
import {$, button} from './dom';
import {pointOf} from './large_view';
import {demandLanding} from './planning';
import {kMaxLanding} from './saved';
import {lengthText, limited, type Place} from './place';
import {pause} from './transport';

/** A key's step; with Shift ten times as far, m. */
const kStep = 0.005;
/** After the last key before it is planned, ms. */
const kPatience = 700;

/** What is missed by less is met, m. */
const kWorthTelling = 0.002;
/** Half of the grip's, px. */
const kGripSize = 22;
/** Above the bar of exports, px. */
const kExports = 84;

const grip = button('landing');
/** While it is moved: where to, m from the first contact. */
let moving: Place | null = null;
let timer = 0;
/** Whether keys moved it when the takes before were dropped: so they may go on. */
let focused = false;

whenChanged(['takes', 'choice'], show);

const placeOf = (contact: MotionContact | undefined): Place | null => contact ? [contact.position[0], contact.position[1]] : null;
const startOf = (take: Take | undefined): Place | null => placeOf(take?.motion.contacts[0]);
const sum = (a: Place, b: Place): Place => [a[0] + b[0], a[1] + b[1]];
const difference = (a: Place, b: Place): Place => [a[0] - b[0], a[1] - b[1]];

/** Where the chosen take lands, m from its first contact; null where it meets no other. */
function landed(): Place | null {
  const contacts = chosenTake()?.motion.contacts ?? [];
  const start = startOf(chosenTake());
  const last = contacts.length > 1 ? placeOf(contacts.at(-1)) : null;
  return start && last && difference(last, start);
}

const asked = (): Place | null => moving ?? current.saved.landing;
const shown = (): Place | null => asked() ?? landed();

function show(): void {
  const {landing} = current.saved;
  const place = shown();
  const wish = asked();
  const there = landed();
  $('landing-row').hidden = !place;
  $('landing-clear').hidden = !landing;
  const off = !moving && landing && there ? difference(there, landing) : null;
  $('landing-text').textContent = wish ? `${lengthText(wish)} from its start` : 'anywhere';
  $('landing-off').textContent = off && Math.hypot(...off) > kWorthTelling ? `This take misses that by ${lengthText(off)}.` : '';
  grip.setAttribute('aria-label', place ? `Landing place, ${lengthText(place)} from where it first touches${wish ? ', asked for' : ''}` : 'Landing place');
  if (!chosenTake()?.scene) {
    focused ||= document.activeElement === grip;
    grip.hidden = true;
  }
  for (const take of current.takes) {
    const start = startOf(take);
    if (start) take.scene?.setLanding(start, wish && sum(start, wish));
  }
}

/** To be called with each frame: the grip goes with the place on the floor. @returns what the picture depends on */
export function placeGrip(): string {
  const scene = chosenTake()?.scene;
  const start = startOf(chosenTake());
  const place = shown();
  grip.hidden = !scene || !start || !place;
  if (!scene || !start || !place) return '';
  if (focused && document.activeElement === document.body) grip.focus({preventScroll: true});
  focused = false;
  // On the side of the ring that is nearest, so that it does not cover the body.
  const [rx, ry] = scene.rightwards();
  const near: Place = [ry * scene.ringRadius, -rx * scene.ringRadius];
  const seen = scene.seenAt(sum(sum(start, place), near));
  const {clientWidth, clientHeight} = $('view');
  // What is out of sight waits at the edge.
  const within = (value: number, most: number, below = kGripSize): number => Math.min(Math.max(value, kGripSize), most - below);
  const x = within(((seen?.[0] ?? 0) * 0.5 + 0.5) * clientWidth, clientWidth);
  const y = within((0.5 - (seen?.[1] ?? -1) * 0.5) * clientHeight, clientHeight, kExports);
  grip.classList.toggle('far', !seen || Math.max(Math.abs(seen[0]), Math.abs(seen[1])) > 1);
  grip.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  return String(asked());
}

function move(to: Place): void {
  moving = limited(to, kMaxLanding);
  show();
}

/** Asks for where it was moved to. */
function settle(): void {
  clearTimeout(timer);
  const to = moving;
  moving = null;
  if (to) demandLanding(to);
  else show();
}

function giveUp(): void {
  moving = null;
  settle();
}

function drag(down: PointerEvent): void {
  const scene = chosenTake()?.scene;
  const from = shown();
  const touched = scene?.floorAt(...pointOf(down));
  if (down.button !== 0 || !scene || !from || !touched) return;
  pause(); // what follows the body would turn under the pointer
  grip.setPointerCapture(down.pointerId);
  const follow = (event: PointerEvent): void => {
    const now = scene.floorAt(...pointOf(event));
    const travelled = moving || Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) > 3;
    if (now && travelled) move(sum(from, difference(now, touched)));
  };
  const end = (event: Event): void => {
    grip.removeEventListener('pointermove', follow);
    for (const name of ['pointerup', 'pointercancel']) grip.removeEventListener(name, end);
    if (event.type === 'pointerup') settle();
    else giveUp();
  };
  grip.addEventListener('pointermove', follow);
  for (const name of ['pointerup', 'pointercancel']) grip.addEventListener(name, end);
}

function keyDown(event: KeyboardEvent): void {
  const scene = chosenTake()?.scene;
  const from = shown();
  const way = {ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
  if (!scene || !from) return;
  if (way) {
    const [rx, ry] = scene.rightwards();
    const step = kStep * (event.shiftKey ? 10 : 1);
    const [right, away] = [way[0]! * step, way[1]! * step];
    move(sum(from, [right * rx - away * ry, right * ry + away * rx]));
    clearTimeout(timer);
    timer = window.setTimeout(settle, kPatience);
  } else if (event.key === 'Enter') settle();
  else if (event.key === 'Escape' && moving) giveUp();
  else if (event.key === 'Delete' || event.key === 'Backspace') clear();
  else return;
  event.preventDefault();
  event.stopPropagation();
}

function clear(): void {
  moving = null;
  clearTimeout(timer);
  if (current.saved.landing) demandLanding(null);
}

export function wireLanding(): void {
  grip.addEventListener('pointerdown', drag);
  grip.addEventListener('keydown', keyDown);
  $('landing-clear').addEventListener('click', clear);
}
