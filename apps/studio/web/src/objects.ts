// SPDX-License-Identifier: Apache-2.0
// The library of objects as pictures to choose from.
import type {CatalogueObject} from './api';
import {$, input} from './dom';

const pictures = import.meta.glob<string>('../../../../docs/objects/*.png', {query: '?url', import: 'default', eager: true});

export function pictureOf(name: string): string {
  const found = Object.entries(pictures).find(([path]) => path.endsWith(`/${name}.png`));
  return found ? `url("${found[1]}")` : 'none';
}

export function openObjects(): void {
  $<HTMLDialogElement>('objects').showModal();
  $('object-search').focus();
}

/** Fills the grid of the dialog; `choose` gets the name. */
export function fillGrid(objects: readonly CatalogueObject[], choose: (name: string) => void): void {
  const search = input('object-search');
  const buttons = objects.map((object) => {
    const button = document.createElement('button');
    const picture = document.createElement('span');
    picture.className = 'picture';
    picture.style.backgroundImage = pictureOf(object.name);
    const frame = document.createElement('span');
    frame.className = 'frame';
    frame.append(picture);
    button.append(frame, object.title);
    button.dataset['name'] = object.name;
    button.addEventListener('click', () => choose(object.name));
    return button;
  });
  $('object-grid').replaceChildren(...buttons);
  search.addEventListener('input', () => {
    const words = search.value.toLowerCase();
    objects.forEach((object, i) => {
      buttons[i]!.hidden = !`${object.name} ${object.title} ${object.material}`.toLowerCase().includes(words);
    });
  });
  search.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter') return;
    event.preventDefault(); // the button that has the focus afterwards would take the key too
    buttons.find((button) => !button.hidden)?.click();
  });
}
