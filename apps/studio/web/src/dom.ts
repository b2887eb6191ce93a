// SPDX-License-Identifier: Apache-2.0
// The page's elements, and telling something to who looks at it.
import {StudioError} from './api';

export const $ = <T extends HTMLElement = HTMLElement>(id: string): T => document.getElementById(id) as T;
export const button = (id: string): HTMLButtonElement => $<HTMLButtonElement>(id);
export const input = (id: string): HTMLInputElement => $<HTMLInputElement>(id);
export const select = (id: string): HTMLSelectElement => $<HTMLSelectElement>(id);

let toastTimer = 0;
export function toast(text: string): void {
  // What is not in an open dialog lies under it.
  (document.querySelector('dialog[open]') ?? document.body).append($('toast'));
  $('toast').textContent = text;
  $('toast').hidden = false;
  clearTimeout(toastTimer);
  toastTimer = window.setTimeout(() => ($('toast').hidden = true), 6000);
}

export function tellError(error: unknown): void {
  if (error instanceof DOMException && error.name === 'AbortError') return;
  const remedy = error instanceof StudioError && error.remedy ? ` — ${error.remedy}` : '';
  const text = error instanceof Error ? error.message : String(error);
  toast(text.charAt(0).toUpperCase() + text.slice(1) + remedy);
}

export function showTip(text: string, x: number, y: number): void {
  const tip = $('tip');
  tip.hidden = text === '';
  tip.textContent = text;
  tip.style.left = `${Math.min(x + 14, innerWidth - 290)}px`;
  tip.style.top = `${Math.min(y + 16, innerHeight - tip.offsetHeight - 8)}px`;
}

/** Runs while the page shows that it is busy; errors are told. */
export async function whileBusy(work: () => Promise<void>): Promise<void> {
  document.body.classList.add('busy');
  try {
    await work();
  } catch (error) {
    tellError(error);
  } finally {
    document.body.classList.remove('busy');
  }
}

export function download(name: string, href: string): void {
  const link = document.createElement('a');
  link.href = href;
  link.download = name;
  link.click();
}

export function downloadText(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], {type: 'text/plain'}));
  download(name, url);
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
