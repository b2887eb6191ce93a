// SPDX-License-Identifier: Apache-2.0
// The page: which button does what, files that are dropped, and the start.
import * as api from './api';
import {chooseObject, inOrder, openMesh, openOwn, wireOptions} from './choice';
import {addAt, deleteChosen, loadLabels, mergeChosen, saveLabels, setTerminal, snapChosen, splitChosen, step, timeline} from './contacts';
import {current} from './current';
import {$, input, tellError} from './dom';
import exampleUrl from './example.wav?url';
import {frame, measured} from './frames';
import {job} from './job';
import {keyDown} from './keys';
import {wireLanding} from './landing';
import {wireLargeView} from './large_view';
import {fillGrid, openObjects} from './objects';
import {animate} from './planning';
import {recordOrStop} from './record_button';
import {leave, openFile, openSession, saveProject} from './sessions';
import {chooseNextTake, exportFilm} from './takes';
import {setSpeed, toggleLoop, togglePlay} from './transport';

function wireButtons(): void {
  const on = (id: string, action: () => void): void => $(id).addEventListener('click', action);
  const position = (): number => current.player?.position ?? 0;
  on('choose-sound', () => $('sound-file').click());
  on('new-sound', leave);
  on('example', () => void fetch(exampleUrl).then((answer) => answer.blob()).then((blob) => openFile(blob, 'example.wav')).catch(tellError));
  on('record', () => void recordOrStop((sound) => openFile(sound, 'recording.wav')));
  on('save-project', () => void saveProject().catch(tellError));
  on('play', () => void togglePlay());
  on('loop', () => void toggleLoop());
  on('undo', () => step('undo'));
  on('redo', () => step('redo'));
  on('add', () => addAt(position()));
  on('snap', snapChosen);
  on('split', splitChosen);
  on('merge', mergeChosen);
  on('delete', deleteChosen);
  on('zoom-in', () => timeline.zoom(0.6, position()));
  on('zoom-out', () => timeline.zoom(1.7, position()));
  on('labels-in', () => $('labels-file').click());
  on('labels-out', saveLabels);
  on('object', openObjects);
  on('own-mesh', openOwn);
  on('own-change', openOwn);
  on('plan', () => (job.runs ? job.cancel() : void animate()));
  on('export-film', () => void exportFilm(false));
  on('export-hd', () => void exportFilm(true));
  on('help', () => $<HTMLDialogElement>('keys').showModal());
  document.querySelectorAll('[data-close]').forEach((one) => one.addEventListener('click', () => one.closest('dialog')!.close()));
  $('terminal').addEventListener('change', () => setTerminal(input('terminal').checked));
  $('speed').addEventListener('change', () => void setSpeed());
  $('takes-list').addEventListener('keydown', (event) => {
    const by = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (!by) return;
    event.preventDefault();
    chooseNextTake(by);
  });
}

function wireFiles(): void {
  const picked = (id: string, use: (file: File) => Promise<void>): void => $(id).addEventListener('change', () => {
    const file = input(id).files?.[0];
    input(id).value = '';
    if (file) void use(file);
  });
  picked('sound-file', (file) => openFile(file, file.name));
  picked('labels-file', loadLabels);
  picked('mesh-file', (file) => openMesh(file, file.name));
  document.addEventListener('dragover', (event) => {
    event.preventDefault();
    document.body.classList.add('dropping');
  });
  document.addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) document.body.classList.remove('dropping');
  });
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    const labels = file.name.toLowerCase().endsWith('.txt') && current.session;
    void (labels ? loadLabels(file) : openFile(file, file.name));
  });
}

async function start(): Promise<void> {
  wireButtons();
  wireOptions();
  wireFiles();
  wireLargeView();
  wireLanding();
  document.addEventListener('keydown', keyDown);
  requestAnimationFrame(frame);
  const id = /^#s=([0-9a-f]{32})$/.exec(location.hash)?.[1];
  try {
    const [list, before] = await Promise.all([api.objects(), id ? api.session(id) : null]);
    current.catalogue = inOrder(list);
    fillGrid(current.catalogue, chooseObject);
    if (before) await openSession(before);
  } catch (error) {
    tellError(error);
  }
}

Object.assign(window, {studio: measured});
void start();
