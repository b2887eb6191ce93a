// SPDX-License-Identifier: Apache-2.0
// The sound as a picture, waveform above and spectrogram below, with its contacts as handles on it.
// Only what is in sight is drawn, so that a zoom to single samples costs no more than the whole.
import {isClick, type Mark, type Marking} from './marks';
import {Spectrum, type Waveform} from './signal';

const kRuler = 18; // px
const kWaveShare = 0.46; // of the height above the ruler
const kShortestView = 0.02; // s
const kLowest = 100; // Hz, of the spectrogram
const kFinger = 22; // px, half of what a finger covers

export interface TimelineActions {
  choose(id: number | null): void;
  move(id: number, start: number, free: boolean): void;
  end(id: number, end: number): void;
  add(time: number): void;
  seek(time: number): void;
  hover(id: number | null, x: number, y: number): void;
}

/** Of a mark that a motion meets. */
export interface Look {
  tone: string;
  note: string;
}

type Rgb = [number, number, number];

function rgb(text: string): Rgb {
  const hex = text.trim().replace('#', '');
  return [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)) as Rgb;
}

export class Timeline {
  private readonly canvas: HTMLCanvasElement;
  private readonly layer: HTMLElement;
  private readonly playhead: HTMLElement;
  private readonly loopSpan: HTMLElement;
  private readonly handles = new Map<number, HTMLElement>();
  private wave: Waveform | null = null;
  private marking: Marking = {marks: [], terminal: true};
  private chosen: number | null = null;
  private looks: ReadonlyMap<number, Look> = new Map();
  private from = 0;
  private to = 1;
  private width = 1;
  private height = 1;
  private drawAsked = false;
  /** The pointer that scrubs or drags. */
  private held: {pointer: PointerEvent; stop: () => void} | null = null;

  constructor(private readonly track: HTMLElement, private readonly actions: TimelineActions) {
    this.canvas = track.querySelector('canvas')!;
    this.layer = track.querySelector('.marks')!;
    this.playhead = track.querySelector('.playhead')!;
    this.loopSpan = track.querySelector('.loop-span')!;
    new ResizeObserver(() => this.measure()).observe(track);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.askDraw());
    track.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    track.addEventListener('pointerdown', (event) => this.pointerDown(event));
    track.addEventListener('dblclick', (event) => {
      if (!this.markOf(event.target)) this.actions.add(this.timeAt(event.clientX));
    });
    this.layer.addEventListener('pointermove', (event) => {
      this.actions.hover(this.markOf(event.target), event.clientX, event.clientY);
    });
    this.layer.addEventListener('pointerout', (event) => {
      if (event.pointerType !== 'touch') this.actions.hover(null, 0, 0);
    });
    this.layer.addEventListener('focusin', (event) => this.actions.choose(this.markOf(event.target)));
  }

  show(wave: Waveform): void {
    this.wave = wave;
    this.from = 0;
    this.to = wave.duration;
    this.measure();
  }

  setMarks(marking: Marking, chosen: number | null, looks: ReadonlyMap<number, Look>): void {
    this.marking = marking;
    this.chosen = chosen;
    this.looks = looks;
    this.placeMarks();
  }

  focusMark(id: number): void {
    this.handles.get(id)?.focus({preventScroll: true});
    const mark = this.marking.marks.find((one) => one.id === id);
    if (mark && (mark.start < this.from || mark.start > this.to)) this.setView(mark.start - (this.to - this.from) / 2);
  }

  setPosition(time: number): void {
    const x = this.xOf(time);
    this.playhead.style.transform = `translateX(${x.toFixed(2)}px)`;
    this.playhead.hidden = x < 0 || x > this.width;
  }

  setLoop(span: {from: number; to: number} | null): void {
    this.loopSpan.hidden = span === null;
    if (!span) return;
    this.loopSpan.dataset['from'] = String(span.from);
    this.loopSpan.dataset['to'] = String(span.to);
    this.placeLoop();
  }

  /** @param centre s that stays where it is */
  zoom(factor: number, centre = (this.from + this.to) / 2): void {
    if (!this.wave) return;
    const length = Math.min(this.wave.duration, Math.max(kShortestView, (this.to - this.from) * factor));
    const share = (centre - this.from) / (this.to - this.from);
    this.to = this.from + length;
    this.setView(centre - share * length);
  }

  showAll(): void {
    if (this.wave) this.zoom(1e9);
  }

  private setView(from: number): void {
    const length = this.to - this.from;
    this.from = Math.min(Math.max(from, 0), (this.wave?.duration ?? 1) - length);
    this.to = this.from + length;
    this.askDraw();
  }

  private xOf(time: number): number {
    return ((time - this.from) / (this.to - this.from)) * this.width;
  }
  timeAt(clientX: number): number {
    const left = this.track.getBoundingClientRect().left + this.track.clientLeft;
    const time = this.from + ((clientX - left) / this.width) * (this.to - this.from);
    return Math.min(Math.max(time, 0), this.wave?.duration ?? 0);
  }
  /** Seconds that so many pixels are. */
  reach(pixels: number): number {
    return (pixels / this.width) * (this.to - this.from);
  }

  private markOf(target: EventTarget | null): number | null {
    const element = (target as HTMLElement | null)?.closest?.('.mark') as HTMLElement | null;
    return element ? Number(element.dataset['id']) : null;
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      this.setView(this.from + this.reach(event.deltaX || event.deltaY));
    } else {
      this.zoom(Math.exp(event.deltaY * 0.002), this.timeAt(event.clientX));
    }
  }

  /** The mark that a finger means: the nearest number, as far as a finger is wide. */
  private markUnderFinger(event: PointerEvent): number | null {
    const box = this.track.getBoundingClientRect();
    const onEnd = (event.target as HTMLElement).classList.contains('handle');
    if (onEnd || event.clientY - box.top > kWaveShare * box.height) return this.markOf(event.target);
    const off = (mark: Mark): number => Math.abs(this.xOf(mark.start) - (event.clientX - box.left - this.track.clientLeft));
    const nearest = [...this.marking.marks].sort((a, b) => off(a) - off(b))[0];
    return nearest && off(nearest) <= kFinger ? nearest.id : this.markOf(event.target);
  }

  /** Follows a pointer until it goes up or `stop` is called, which it returns. */
  private follow(pointer: PointerEvent, move: (event: PointerEvent) => void): () => void {
    this.track.setPointerCapture(pointer.pointerId);
    const own = (event: PointerEvent): void => {
      if (event.pointerId === pointer.pointerId) move(event);
    };
    const up = (event: PointerEvent): void => {
      if (event.pointerId === pointer.pointerId) stop();
    };
    const stop = (): void => {
      this.track.removeEventListener('pointermove', own);
      for (const name of ['pointerup', 'pointercancel'] as const) this.track.removeEventListener(name, up);
      if (this.held?.stop === stop) this.held = null;
    };
    this.track.addEventListener('pointermove', own);
    for (const name of ['pointerup', 'pointercancel'] as const) this.track.addEventListener(name, up);
    return stop;
  }

  /** Two fingers: the moments under them stay under them. */
  private pinch(a: PointerEvent, b: PointerEvent): void {
    const middle = (this.timeAt(a.clientX) + this.timeAt(b.clientX)) / 2;
    const length = this.to - this.from;
    const apart = (x: number, y: number): number => Math.max(kFinger, Math.abs(x - y));
    const at = {a: a.clientX, b: b.clientX};
    const show = (): void => {
      this.zoom((length * apart(a.clientX, b.clientX)) / apart(at.a, at.b) / (this.to - this.from));
      const left = this.track.getBoundingClientRect().left + this.track.clientLeft;
      this.setView(middle - this.reach((at.a + at.b) / 2 - left));
    };
    this.follow(a, (event) => (at.a = event.clientX, show()));
    this.follow(b, (event) => (at.b = event.clientX, show()));
  }

  private pointerDown(event: PointerEvent): void {
    if (event.button !== 0 || !this.wave) return;
    event.preventDefault();
    const touch = event.pointerType === 'touch';
    if (touch && this.held) {
      const {pointer, stop} = this.held;
      stop();
      return this.pinch(pointer, event);
    }
    const id = touch ? this.markUnderFinger(event) : this.markOf(event.target);
    const stop = id === null ? this.scrub(event) : this.drag(event, id);
    this.held = {pointer: event, stop};
    this.actions.hover(touch ? id : null, event.clientX, event.clientY); // a finger does not hover
  }

  private scrub(event: PointerEvent): () => void {
    this.actions.choose(null);
    this.actions.seek(this.timeAt(event.clientX));
    return this.follow(event, (moved) => this.actions.seek(this.timeAt(moved.clientX)));
  }

  private drag(event: PointerEvent, id: number): () => void {
    const onEnd = (event.target as HTMLElement).classList.contains('handle');
    const mark = this.marking.marks.find((one) => one.id === id);
    const grip = mark ? this.timeAt(event.clientX) - (onEnd ? mark.end : mark.start) : 0;
    this.handles.get(id)?.focus({preventScroll: true});
    let travelled = false;
    return this.follow(event, (moved) => {
      travelled ||= Math.abs(moved.clientX - event.clientX) > 2;
      const time = this.timeAt(moved.clientX) - grip;
      if (travelled && onEnd) this.actions.end(id, time);
      else if (travelled) this.actions.move(id, time, moved.altKey);
    });
  }

  private measure(): void {
    this.width = Math.max(1, this.track.clientWidth);
    this.height = Math.max(1, this.track.clientHeight);
    const scale = Math.min(2, devicePixelRatio);
    this.canvas.width = Math.round(this.width * scale);
    this.canvas.height = Math.round(this.height * scale);
    this.askDraw();
  }

  private askDraw(): void {
    this.placeMarks();
    this.placeLoop();
    if (this.drawAsked) return;
    this.drawAsked = true;
    requestAnimationFrame(() => {
      this.drawAsked = false;
      this.draw();
    });
  }

  private placeLoop(): void {
    const {from, to} = this.loopSpan.dataset;
    if (from === undefined || to === undefined) return;
    const left = this.xOf(Number(from));
    this.loopSpan.style.left = `${left}px`;
    this.loopSpan.style.width = `${this.xOf(Number(to)) - left}px`;
  }

  private placeMarks(): void {
    const seen = new Set<number>();
    let lastX = -100;
    this.marking.marks.forEach((mark, i) => {
      seen.add(mark.id);
      const handle = this.handles.get(mark.id) ?? this.makeHandle(mark.id);
      const x = this.xOf(mark.start);
      const last = i + 1 === this.marking.marks.length;
      handle.hidden = x < -20 || x > this.width + 20;
      handle.style.left = `${x}px`;
      handle.dataset['number'] = String(i + 1);
      handle.classList.toggle('chosen', mark.id === this.chosen);
      handle.classList.toggle('doubt', mark.confidence < 0.9);
      handle.classList.toggle('last', last);
      handle.classList.toggle('rests', this.marking.terminal);
      handle.classList.toggle('crowded', x - lastX < 18);
      lastX = x;
      handle.style.setProperty('--sure', (0.3 + 0.7 * mark.confidence).toFixed(2));
      const tone = this.looks.get(mark.id)?.tone;
      if (tone) handle.style.setProperty('--tone', tone);
      else handle.style.removeProperty('--tone');
      this.describe(handle, mark, i, last);
      // Elements stand in the order of time, so that Tab goes from contact to contact.
      if (this.layer.children[i] !== handle) this.layer.insertBefore(handle, this.layer.children[i] ?? null);
    });
    for (const [id, handle] of this.handles) {
      if (seen.has(id)) continue;
      handle.remove();
      this.handles.delete(id);
    }
  }

  private makeHandle(id: number): HTMLElement {
    const handle = document.createElement('div');
    handle.className = 'mark';
    handle.tabIndex = 0;
    handle.dataset['id'] = String(id);
    handle.setAttribute('role', 'slider');
    handle.innerHTML = '<div class="length"></div><div class="handle"></div>';
    this.handles.set(id, handle);
    return handle;
  }

  private describe(handle: HTMLElement, mark: Mark, index: number, last: boolean): void {
    const width = isClick(mark) ? 0 : this.xOf(mark.end) - this.xOf(mark.start);
    const length = handle.children[0] as HTMLElement;
    const grip = handle.children[1] as HTMLElement;
    length.style.width = `${width}px`;
    grip.hidden = width === 0;
    grip.style.left = `${width}px`;
    const until = isClick(mark) ? '' : `, a rattle until ${mark.end.toFixed(3)} s`;
    const sure = mark.confidence < 1 ? `, ${Math.round(100 * mark.confidence)} % sure` : '';
    const rests = last && this.marking.terminal ? ', comes to rest' : '';
    handle.setAttribute('aria-label', `Contact ${index + 1}`);
    handle.setAttribute('aria-valuemin', '0');
    handle.setAttribute('aria-valuemax', (this.wave?.duration ?? 0).toFixed(3));
    handle.setAttribute('aria-valuenow', mark.start.toFixed(4));
    handle.setAttribute('aria-description', this.looks.get(mark.id)?.note ?? '');
    handle.setAttribute('aria-valuetext', `${mark.start.toFixed(3)} s${until}${sure}${rests}`);
  }

  private draw(): void {
    const wave = this.wave;
    const context = this.canvas.getContext('2d');
    if (!wave || !context) return;
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string): string => style.getPropertyValue(name).trim();
    const {width, height} = this.canvas;
    const ruler = Math.round((kRuler * height) / this.height);
    const waveHeight = Math.round((height - ruler) * kWaveShare);
    context.fillStyle = colour('--panel');
    context.fillRect(0, 0, width, height);
    this.drawWave(context, wave, waveHeight, colour('--wave'));
    this.drawSpectrogram(context, wave, waveHeight, height - ruler - waveHeight, rgb(colour('--panel')), rgb(colour('--accent')));
    this.drawRuler(context, height - ruler, colour('--quiet'), colour('--line'));
  }

  private drawWave(context: CanvasRenderingContext2D, wave: Waveform, height: number, colour: string): void {
    const {width} = this.canvas;
    const middle = height / 2;
    const step = (this.to - this.from) / width;
    context.fillStyle = colour;
    context.beginPath();
    for (let x = 0; x < width; ++x) {
      const time = this.from + x * step;
      const [low, high] = wave.extent(time, time + step);
      // Quiet touches matter as much as loud ones: the square root lifts them.
      const top = middle - Math.sign(high) * Math.sqrt(Math.abs(high)) * middle * 0.94;
      const bottom = middle - Math.sign(low) * Math.sqrt(Math.abs(low)) * middle * 0.94;
      context.rect(x, Math.min(top, bottom), 1, Math.max(1, Math.abs(bottom - top)));
    }
    context.fill();
  }

  private drawSpectrogram(context: CanvasRenderingContext2D, wave: Waveform, top: number, height: number, ground: Rgb, ink: Rgb): void {
    const {width} = this.canvas;
    const step = ((this.to - this.from) / width) * wave.rate; // samples a pixel
    const size = step > 96 ? 1024 : step > 12 ? 512 : 256;
    const spectrum = new Spectrum(size);
    const image = context.createImageData(width, height);
    const highest = Math.min(16000, wave.rate / 2);
    const bands = Array.from({length: height}, (_, y) => {
      const frequency = kLowest * (highest / kLowest) ** (1 - y / height);
      return Math.min(size / 2 - 1, (frequency * size) / wave.rate);
    });
    const full = 20 * Math.log10((wave.peak * size) / 8);
    for (let x = 0; x < width; ++x) {
      spectrum.at(wave.samples, Math.round((this.from * wave.rate) + (x + 0.5) * step));
      for (let y = 0; y < height; ++y) {
        const band = Math.floor(bands[y]!);
        const part = bands[y]! - band;
        const power = spectrum.power[band]! * (1 - part) + (spectrum.power[band + 1] ?? 0) * part;
        const level = Math.min(1, Math.max(0, 1 + (10 * Math.log10(power + 1e-20) - full) / 66));
        const at = 4 * (y * width + x);
        for (let c = 0; c < 3; ++c) image.data[at + c] = ground[c]! + (ink[c]! - ground[c]!) * level ** 1.5;
        image.data[at + 3] = 255;
      }
    }
    context.putImageData(image, 0, top);
  }

  private drawRuler(context: CanvasRenderingContext2D, top: number, text: string, line: string): void {
    const {width, height} = this.canvas;
    const scale = height / this.height;
    const wanted = ((this.to - this.from) / this.width) * 90;
    const power = 10 ** Math.floor(Math.log10(wanted));
    const step = [1, 2, 5, 10].map((f) => f * power).find((f) => f >= wanted)!;
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    context.fillStyle = line;
    context.fillRect(0, top, width, 1);
    context.font = `${11 * scale}px system-ui, sans-serif`;
    context.textBaseline = 'middle';
    for (let time = Math.ceil(this.from / step) * step; time <= this.to; time += step) {
      const x = this.xOf(time) * scale;
      context.fillStyle = line;
      context.fillRect(x, top, 1, height - top);
      context.fillStyle = text;
      context.fillText(`${time.toFixed(digits)} s`, x + 4 * scale, (top + height) / 2 + 1);
    }
  }
}
