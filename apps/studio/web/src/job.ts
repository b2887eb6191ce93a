// SPDX-License-Identifier: Apache-2.0
// What the studio's server works at for this page, with its progress shown.
import type {Tell} from './api';
import {changed} from './current';
import {$, tellError} from './dom';

const kStages: Record<string, string> = {
  learn: 'Getting to know the object', build: 'Dropping it many times', index: 'Dropping it many times',
  search: 'Looking for motions', film: 'Drawing the film',
};

function showProgress(event: string, data: Record<string, unknown>): void {
  const bar = $('progress').querySelector('progress')!;
  if (event === 'queued') {
    const before = Number(data['before']);
    $('stage-name').textContent = before > 0 ? `Waiting for ${before} other job${before === 1 ? '' : 's'}` : 'Starting';
  } else if (event === 'progress') {
    const name = String(data['stage']);
    $('stage-name').textContent = kStages[name] ?? name.charAt(0).toUpperCase() + name.slice(1);
    bar.value = Number(data['value']);
  }
}

/** One job at a time. */
class CurrentJob {
  private controller: AbortController | null = null;

  get runs(): boolean {
    return this.controller !== null;
  }

  cancel(): void {
    this.controller?.abort();
  }

  /** Cancels the job before. @returns null where it failed, which has been told, or was cancelled */
  async run<T>(work: (signal: AbortSignal, tell: Tell) => Promise<T>): Promise<T | null> {
    this.cancel();
    const own = new AbortController();
    this.controller = own;
    $('stage-name').textContent = 'Starting';
    $('progress').querySelector('progress')!.value = 0;
    $('progress').hidden = false;
    changed('job');
    try {
      return await work(own.signal, showProgress);
    } catch (error) {
      tellError(error);
      return null;
    } finally {
      if (this.controller === own) {
        this.controller = null;
        $('progress').hidden = true;
      }
      changed('job');
    }
  }
}

export const job = new CurrentJob();
