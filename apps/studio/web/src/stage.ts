// SPDX-License-Identifier: Apache-2.0
// Takes as 3D pictures. One WebGL context draws all views, one after the other, and each is copied to
// its own canvas: browsers allow few contexts, and one shares what is loaded.
import * as THREE from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import type {Motion} from './api';
import type {Place} from './place';

export interface ContactSpot {
  position: [number, number, number];
  colour: string;
}

/** Where the camera looks at each moment: the path, smoothed over half a second. */
class Aim {
  private readonly points: THREE.Vector3[] = [];
  private static readonly rate = 60;

  constructor(motion: Motion, private readonly shift: number) {
    const {time, position} = motion.trajectory;
    const end = time[time.length - 1] ?? 0;
    const half = 0.25;
    for (let t = time[0] ?? 0, low = 0, high = 0; t <= end; t += 1 / Aim.rate) {
      while (low < time.length - 1 && time[low]! < t - half) ++low;
      while (high < time.length - 1 && time[high]! < t + half) ++high;
      const sum = new THREE.Vector3();
      // Samples lie denser in contacts; every one counts for the time to the next.
      let weight = 0;
      for (let i = low; i < Math.max(high, low + 1); ++i) {
        const share = Math.max((time[i + 1] ?? time[i]!) - time[i]!, 1e-6);
        const [x, y, z] = position[i]!;
        sum.addScaledVector(new THREE.Vector3(x, z, -y), share);
        weight += share;
      }
      this.points.push(sum.divideScalar(weight));
    }
    this.start = time[0] ?? 0;
  }
  private readonly start: number;

  /** @param soundTime s in the sound */
  at(soundTime: number): THREE.Vector3 {
    const index = (soundTime + this.shift - this.start) * Aim.rate;
    const i = Math.min(Math.max(Math.floor(index), 0), this.points.length - 1);
    const next = this.points[Math.min(i + 1, this.points.length - 1)]!;
    return this.points[i]!.clone().lerp(next, Math.min(Math.max(index - i, 0), 1));
  }
}

function boundsOf(motion: Motion): THREE.Sphere {
  const points = motion.trajectory.position.map(([x, y, z]) => new THREE.Vector3(x, z, -y));
  return new THREE.Box3().setFromPoints(points).getBoundingSphere(new THREE.Sphere());
}

/** One take: its own little world. */
export class TakeScene {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(32, 1, 0.001, 100);
  private readonly mixer: THREE.AnimationMixer;
  private readonly actions: THREE.AnimationAction[] = [];
  private readonly body: THREE.Object3D;
  private readonly radius: number;
  /** Half of what the picture shows, m. */
  private readonly sight: number;
  private readonly aim: Aim;
  private readonly still: THREE.Vector3 | null;
  private readonly looking = new THREE.Vector3();
  private readonly light = new THREE.DirectionalLight(0xfff4e4, 2.4);
  private readonly sky = new THREE.HemisphereLight(0xffffff, 0x998f84, 1.5);
  private readonly floor: THREE.Mesh<THREE.CircleGeometry, THREE.ShadowMaterial>;
  private readonly grid: THREE.GridHelper;
  private readonly spots = new THREE.Group();
  private readonly landing = new THREE.Group();
  private readonly ring: THREE.Mesh<THREE.RingGeometry, THREE.MeshBasicMaterial>;
  private readonly way: THREE.Line<THREE.BufferGeometry, THREE.LineDashedMaterial>;
  /** Seconds of the animation at second 0 of the sound: `ifa sync` may put silence before it. */
  readonly shift: number;

  constructor(gltf: {scene: THREE.Group; animations: THREE.AnimationClip[]}, motion: Motion, firstContact: number,
              shadowPixels: number) {
    this.shift = motion.sound.first_contact - firstContact;
    this.body = gltf.scene;
    this.body.traverse((part) => {
      part.castShadow = true;
    });
    this.mixer = new THREE.AnimationMixer(this.body);
    for (const clip of gltf.animations) {
      this.actions.push(this.mixer.clipAction(clip).play());
    }
    this.radius = this.bodyRadius();
    // Trajectories count from the first contact, sounds from their start.
    this.aim = new Aim(motion, -firstContact);
    const bounds = boundsOf(motion);
    // A small body that goes far is followed, so that one sees how it lies.
    this.still = bounds.radius < 3 * this.radius ? bounds.center : null;
    this.sight = Math.min(bounds.radius + 1.4 * this.radius, 4.2 * this.radius);
    this.floor = new THREE.Mesh(new THREE.CircleGeometry(60 * this.radius + bounds.radius, 64), new THREE.ShadowMaterial({opacity: 0.32, fog: false}));
    this.floor.rotation.x = -Math.PI / 2;
    this.floor.receiveShadow = true;
    this.grid = new THREE.GridHelper(160 * this.radius, 80);
    this.grid.position.y = 1e-3 * this.radius;
    const marking = {transparent: true, opacity: 0.9, depthWrite: false, fog: false};
    this.ring = new THREE.Mesh(new THREE.RingGeometry(this.ringRadius - 0.1 * this.radius, this.ringRadius, 64), new THREE.MeshBasicMaterial(marking));
    this.ring.rotation.x = -Math.PI / 2;
    this.way = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineDashedMaterial({...marking, dashSize: 0.3 * this.radius, gapSize: 0.2 * this.radius}));
    this.way.frustumCulled = false;
    this.landing.add(this.ring, this.way);
    this.landing.visible = false;
    this.setLight(shadowPixels);
    this.scene.add(this.body, this.floor, this.grid, this.spots, this.landing, this.light, this.light.target, this.sky);
    this.addPath(motion);
    this.aimCamera();
    this.setTime(0);
  }

  private bodyRadius(): number {
    let radius = 1e-3;
    this.body.traverse((part) => {
      if (!(part instanceof THREE.Mesh)) return;
      const geometry = part.geometry as THREE.BufferGeometry;
      const positions = geometry.getAttribute('position');
      for (let i = 0; i < positions.count; ++i) {
        radius = Math.max(radius, Math.hypot(positions.getX(i), positions.getY(i), positions.getZ(i)));
      }
    });
    return radius;
  }

  private setLight(shadowPixels: number): void {
    const reach = 1.5 * this.sight;
    this.light.castShadow = true;
    this.light.shadow.mapSize.set(shadowPixels, shadowPixels);
    this.light.shadow.radius = 4;
    this.light.shadow.bias = -2e-4;
    this.light.shadow.normalBias = 0.01 * this.radius;
    Object.assign(this.light.shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * reach, far: 8 * reach});
    this.light.position.set(-1.2, 3, 1.4).multiplyScalar(reach);
  }

  private aimCamera(): void {
    const distance = (1.25 * this.sight) / Math.sin(THREE.MathUtils.degToRad(this.camera.fov / 2));
    this.camera.position.copy(new THREE.Vector3(0.5, 0.42, 1).normalize().multiplyScalar(distance));
    this.camera.near = distance / 50;
    this.camera.far = distance * 40;
    this.camera.lookAt(0, 0, 0);
    this.scene.fog = new THREE.Fog(0, 1.1 * distance, 3.6 * distance);
  }

  private addPath(motion: Motion): void {
    const points = motion.trajectory.position.map(([x, y, z]) => new THREE.Vector3(x, z, -y));
    const material = new THREE.LineBasicMaterial({color: 0x6a8f8b, transparent: true, opacity: 0.45});
    this.scene.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), material));
  }

  setSpots(spots: readonly ContactSpot[]): void {
    this.spots.clear();
    spots.forEach(({position: [x, y], colour}, i) => {
      const material = new THREE.MeshBasicMaterial({color: colour, transparent: true, opacity: 0.85, depthWrite: false});
      const spot = new THREE.Mesh(new THREE.CircleGeometry(0.16 * this.radius, 24), material);
      spot.rotation.x = -Math.PI / 2;
      spot.position.set(x, 4e-3 * this.radius, -y);
      spot.userData['contact'] = i;
      this.spots.add(spot);
    });
  }

  /** The contact whose spot is seen at that place of the picture (-1 to 1 each way). */
  spotAt(x: number, y: number): number | null {
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(x, y), this.camera);
    const hit = ray.intersectObjects(this.spots.children, false)[0];
    return hit ? (hit.object.userData['contact'] as number) : null;
  }

  /** The normal of the body's surface seen at that place, in the body's own frame (z up); null beside it. */
  normalAt(x: number, y: number): [number, number, number] | null {
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(x, y), this.camera);
    const normal = ray.intersectObject(this.body, true)[0]?.face?.normal;
    return normal ? [normal.x, -normal.z, normal.y] : null;
  }

  setTheme(ground: string, line: string, accent: string): void {
    this.ring.material.color.set(accent);
    this.way.material.color.set(accent);
    this.scene.background = new THREE.Color(ground);
    (this.scene.fog as THREE.Fog).color.set(ground);
    const material = this.grid.material as THREE.LineBasicMaterial;
    material.vertexColors = false;
    material.color.set(line);
    material.needsUpdate = true;
  }

  /** @param soundTime s in the sound  @param controls move with the camera */
  setTime(soundTime: number, controls?: OrbitControls): void {
    for (const action of this.actions) {
      // The very end would be the beginning again.
      const end = action.getClip().duration * (1 - 1e-6);
      action.time = Math.min(Math.max(soundTime + this.shift, 0), end);
    }
    this.mixer.update(0);
    const aim = this.still ?? this.following(soundTime);
    const step = aim.clone().sub(this.looking);
    this.looking.copy(aim);
    this.camera.position.add(step);
    this.light.position.add(step);
    this.light.target.position.copy(aim);
    controls?.target.copy(aim);
  }

  /** The smoothed path, but never so far from the body that it leaves the picture. */
  private following(soundTime: number): THREE.Vector3 {
    const aim = this.aim.at(soundTime);
    const body = this.body.children[0]?.position;
    if (!body) return aim;
    const off = aim.sub(body);
    const most = 0.7 * this.sight;
    const length = off.length();
    return off.multiplyScalar(length > 0 ? (most * Math.tanh(length / most)) / length : 1).add(body);
  }

  get target(): THREE.Vector3 {
    return this.looking;
  }

  /** From where it is looked at, as seen from what is looked at. */
  view(): THREE.Vector3 {
    return this.camera.position.clone().sub(this.looking);
  }

  lookFrom(view: THREE.Vector3): void {
    this.camera.position.copy(this.looking).add(view);
    this.camera.lookAt(this.looking);
  }

  /** The floor seen at that place of the picture (-1 to 1 each way), m; null at and above the horizon. */
  floorAt(x: number, y: number): Place | null {
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(x, y), this.camera);
    const hit = ray.ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 1, 0)), new THREE.Vector3());
    return hit && [hit.x, -hit.z];
  }

  /** Where the floor's `place` is seen, -1 to 1 each way where it is in the picture; null behind who looks. */
  seenAt([x, y]: Place): [number, number] | null {
    const point = new THREE.Vector3(x, 0, -y).project(this.camera);
    return point.z < 1 ? [point.x, point.y] : null;
  }

  /** The way along the floor, of length 1, that goes to the right in the picture. */
  rightwards(): Place {
    const {x, z} = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const length = Math.hypot(x, z);
    return [x / length, -z / length];
  }

  /** Of the ring around the place to land at, m. */
  get ringRadius(): number {
    return 1.25 * this.radius;
  }

  /** A ring around the place to land at, and the way to it. @param place null: none */
  setLanding(start: Place, place: Place | null): void {
    this.landing.visible = place !== null;
    if (!place) return;
    const at = ([x, y]: Place): THREE.Vector3 => new THREE.Vector3(x, 5e-3 * this.radius, -y);
    this.ring.position.copy(at(place));
    this.way.geometry.setFromPoints([at(start), at(place)]);
    this.way.computeLineDistances();
  }

  /** Height of the body's lowest vertex over the floor, m: for measuring. */
  lowestPoint(): number {
    this.scene.updateMatrixWorld(true);
    let low = Infinity;
    const point = new THREE.Vector3();
    this.body.traverse((part) => {
      if (!(part instanceof THREE.Mesh)) return;
      const positions = (part.geometry as THREE.BufferGeometry).getAttribute('position');
      for (let i = 0; i < positions.count; ++i) {
        low = Math.min(low, point.fromBufferAttribute(positions, i).applyMatrix4(part.matrixWorld).y);
      }
    });
    return low;
  }

  dispose(): void {
    this.mixer.stopAllAction();
    this.light.dispose();
    this.scene.traverse((part) => {
      if (!(part instanceof THREE.Mesh || part instanceof THREE.Line)) return;
      (part.geometry as THREE.BufferGeometry).dispose();
      for (const material of [part.material as THREE.Material | THREE.Material[]].flat()) material.dispose();
    });
  }
}

function drawsInSoftware(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const info = context?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? String(context!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** Draws takes: the large one to the canvas of the WebGL context itself, small ones by way of it to theirs. */
export class Stage {
  private renderer: THREE.WebGLRenderer | null = null;
  private readonly loader = new GLTFLoader();
  /** Pixels a CSS pixel: less where frames come slowly. */
  private scale: number;
  private slow = 0;
  /** Whether the processor draws: without smooth edges then, which cost it most. */
  private readonly software = drawsInSoftware();
  private lastLarge = 0;

  constructor(private readonly large: HTMLCanvasElement) {
    this.scale = this.software ? 1 : Math.min(devicePixelRatio, 2);
    try {
      this.renderer = new THREE.WebGLRenderer({canvas: large, antialias: !this.software, powerPreference: 'high-performance'});
      this.renderer.shadowMap.enabled = true;
      this.renderer.shadowMap.type = THREE.PCFShadowMap;
      this.renderer.toneMapping = THREE.NeutralToneMapping;
    } catch {
      this.renderer = null;
    }
  }

  get works(): boolean {
    return this.renderer !== null;
  }

  async load(glb: ArrayBuffer, motion: Motion, firstContact: number): Promise<TakeScene> {
    const gltf = await this.loader.parseAsync(glb, '');
    return new TakeScene(gltf, motion, firstContact, this.software ? 512 : 1024);
  }

  /** For the camera of the large view. */
  controlsOf(take: TakeScene): OrbitControls {
    const controls = new OrbitControls(take.camera, this.large);
    controls.target.copy(take.target);
    controls.enablePan = false;
    controls.maxPolarAngle = 1.54;
    return controls;
  }

  /** @param still nothing moves: a sharp picture may take its time */
  drawLarge(take: TakeScene, still: boolean): void {
    const {large, renderer} = this;
    if (!renderer) return;
    const scale = still ? Math.max(1, devicePixelRatio) : this.scale;
    const width = Math.max(1, Math.round(large.clientWidth * scale));
    const height = Math.max(1, Math.round(large.clientHeight * scale));
    if (large.width !== width || large.height !== height) renderer.setSize(width, height, false);
    this.render(take, width, height);
    const now = performance.now();
    if (!still) this.adapt(now - this.lastLarge);
    this.lastLarge = now;
  }

  /** To be followed by drawLarge in the same frame: it is drawn in a corner of the large canvas first. */
  drawSmall(take: TakeScene, canvas: HTMLCanvasElement): void {
    if (!this.renderer) return;
    const {width: mostWidth, height: mostHeight} = this.large;
    const width = Math.min(mostWidth, canvas.clientWidth);
    const height = Math.min(mostHeight, canvas.clientHeight);
    if (width < 2 || height < 2) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    this.render(take, width, height);
    canvas.getContext('2d')!.drawImage(this.large, 0, mostHeight - height, width, height, 0, 0, width, height);
  }

  private render(take: TakeScene, width: number, height: number): void {
    const renderer = this.renderer!;
    renderer.setViewport(0, 0, width, height);
    renderer.setScissor(0, 0, width, height);
    renderer.setScissorTest(true);
    take.camera.aspect = width / height;
    take.camera.updateProjectionMatrix();
    renderer.render(take.scene, take.camera);
  }

  /** Software rendering: coarser pictures rather than late ones. @param interval ms between two frames */
  private adapt(interval: number): void {
    if (interval > 500) return; // it was not drawn all the time
    this.slow = interval > 40 ? this.slow + 1 : Math.max(0, this.slow - 1);
    if (this.slow < 12 || this.scale <= 0.6) return;
    this.scale = Math.max(0.6, this.scale * 0.8);
    this.slow = 0;
  }
}

export type {OrbitControls};
