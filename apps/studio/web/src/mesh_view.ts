// SPDX-License-Identifier: Apache-2.0
// A mesh to look at from all sides, in its sheet. It has a WebGL context of its own while that is open.
import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {MTLLoader} from 'three/addons/loaders/MTLLoader.js';
import {OBJLoader} from 'three/addons/loaders/OBJLoader.js';

export class MeshView {
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(30, 1, 0.1, 20);
  private readonly controls: OrbitControls;

  /** @param upY whether the file has y upwards, as glTF has; else z. Throws where nothing draws. */
  constructor(private readonly canvas: HTMLCanvasElement, obj: string, mtl: string, upY: boolean) {
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    const materials = new MTLLoader().parse(mtl, '');
    const mesh = new OBJLoader().setMaterials(materials).parse(obj);
    mesh.traverse((part) => {
      if (!(part instanceof THREE.Mesh)) return;
      for (const material of [part.material as THREE.Material | THREE.Material[]].flat()) material.side = THREE.DoubleSide;
    });
    if (!upY) mesh.rotation.x = -Math.PI / 2;
    mesh.updateMatrixWorld(true);
    const ball = new THREE.Box3().setFromObject(mesh).getBoundingSphere(new THREE.Sphere());
    const whole = new THREE.Group();
    mesh.position.sub(ball.center);
    whole.add(mesh);
    whole.scale.setScalar(1 / Math.max(ball.radius, 1e-30));
    const sun = new THREE.DirectionalLight(0xfff4e4, 2.2);
    sun.position.set(-1, 2.4, 1.6);
    this.scene.background = new THREE.Color(0xffffff);
    this.scene.add(whole, sun, new THREE.HemisphereLight(0xffffff, 0x998f84, 1.5));
    this.camera.position.set(1.55, 1.35, 3.1);
    this.camera.lookAt(0, 0, 0);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = false;
    this.controls.addEventListener('change', () => this.draw());
    this.draw();
  }

  draw(): void {
    const {clientWidth, clientHeight} = this.canvas;
    if (clientWidth < 1 || clientHeight < 1) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }

  /** As it is seen now, a square PNG as a data URL. */
  picture(): string {
    const square = document.createElement('canvas');
    square.width = square.height = 224;
    const {width, height} = this.canvas;
    const side = Math.min(width, height);
    square.getContext('2d')!.drawImage(this.canvas, (width - side) / 2, (height - side) / 2, side, side, 0, 0, 224, 224);
    return square.toDataURL('image/png');
  }

  dispose(): void {
    this.controls.dispose();
    this.scene.traverse((part) => {
      if (part instanceof THREE.Mesh) (part.geometry as THREE.BufferGeometry).dispose();
    });
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
