// SPDX-License-Identifier: Apache-2.0
// The sheet in which a person says of their own mesh how large it is and what it is made of.
import * as api from './api';
import {$, button, input, select, tellError} from './dom';
import type {MeshView} from './mesh_view';
import {explainMesh, firstGuess, kMaterials, kUnits, massOf, objectRequest, roundTo3, sizeText, type OwnMesh, type OwnObject, type Unit} from './own';

export class MeshSheet {
  private session = '';
  private mesh: OwnMesh | null = null;
  private own: OwnObject | null = null;
  private view: MeshView | null = null;
  private readonly dialog = $<HTMLDialogElement>('mesh');

  /** @param use is called when the object has been made  @param another to choose another file */
  constructor(private readonly use: (own: OwnObject) => void, another: () => void) {
    select('mesh-units').replaceChildren(...Object.entries(kUnits).map(([unit, {name}]) => new Option(name, unit)));
    select('mesh-material').replaceChildren(...Object.entries(kMaterials).map(([key, {name}]) => new Option(name, key)));
    const changes = (id: string, event: string, change: (own: OwnObject) => void): void => $(id).addEventListener(event, () => {
      if (this.own) change(this.own);
      this.show(id);
    });
    changes('mesh-units', 'change', (own) => (own.units = select('mesh-units').value as Unit));
    changes('mesh-material', 'change', (own) => Object.assign(own, {material: select('mesh-material').value, mass: null}));
    changes('mesh-solid', 'change', (own) => (own.shell = false));
    changes('mesh-shell', 'change', (own) => (own.shell = true));
    changes('mesh-wall', 'input', (own) => (own.wall = Math.max(0, Number(input('mesh-wall').value))));
    // An empty field: as the material has it.
    changes('mesh-mass', 'input', (own) => (own.mass = input('mesh-mass').value === '' ? null : Math.max(0, Number(input('mesh-mass').value))));
    for (const id of ['mesh-wall', 'mesh-mass']) $(id).addEventListener('change', () => this.show()); // when it has been written
    button('mesh-use').addEventListener('click', () => void this.make());
    button('mesh-other').addEventListener('click', another);
    this.dialog.addEventListener('close', () => {
      this.view?.dispose();
      this.view = null;
    });
  }

  /** @param before what was said of it; null: nothing yet */
  open(session: string, mesh: OwnMesh, before: OwnObject | null): void {
    Object.assign(this, {session, mesh, own: before ? {...before} : firstGuess(mesh)});
    $('mesh-title').textContent = mesh.name || 'Your own object';
    if (!this.dialog.open) this.dialog.showModal();
    this.show();
    this.draw().catch(tellError);
  }

  private async draw(): Promise<void> {
    const {session, mesh} = this;
    const [{MeshView: View}, obj, mtl] = await Promise.all([
      import('./mesh_view'), api.meshText(session, 'mesh.obj'), api.meshText(session, 'mesh.mtl'),
    ]);
    if (!this.dialog.open || this.mesh !== mesh) return;
    this.view?.dispose();
    // A canvas that has lost its context gets no other.
    const canvas = $('mesh-view').cloneNode() as HTMLCanvasElement;
    $('mesh-view').replaceWith(canvas);
    this.view = new View(canvas, obj, mtl, mesh?.kind === 'glb');
    performance.mark('mesh drawn');
  }

  /** @param typing the field that is being written in, which is left alone */
  private show(typing = ''): void {
    const {mesh, own} = this;
    if (!mesh || !own) return;
    const {report} = mesh;
    $('mesh-size').textContent = sizeText(report, own.units);
    select('mesh-units').value = own.units;
    select('mesh-material').value = own.material;
    input('mesh-solid').disabled = !report.solid;
    input('mesh-solid').checked = !own.shell;
    input('mesh-shell').checked = own.shell;
    $('mesh-wall-row').hidden = !own.shell || own.mass !== null;
    if (typing !== 'mesh-wall') input('mesh-wall').value = roundTo3(own.wall);
    if (typing !== 'mesh-mass') input('mesh-mass').value = roundTo3(massOf(report, own));
    $('mesh-mass-note').textContent = own.mass === null ? 'by its material' : 'as weighed';
    const {good, texts} = explainMesh(report, own);
    $('mesh-problems').replaceChildren(...texts.map((text) => Object.assign(document.createElement('li'), {textContent: text})));
    button('mesh-use').disabled = !good;
  }

  private async make(): Promise<void> {
    const {mesh, own, session} = this;
    if (!mesh || !own) return;
    button('mesh-use').disabled = true;
    try {
      await api.makeObject(session, objectRequest(mesh.report, own));
      const picture = this.view?.picture() ?? '';
      this.dialog.close();
      this.use({...own, picture});
    } catch (error) {
      tellError(error);
    } finally {
      button('mesh-use').disabled = false;
    }
  }
}
