/** What the sea tells of itself. */
export interface SeaDescription {
  /** State string, such as `wind=14&fetch=300` (docs/parameters.md). */
  state: string;
  /** The sea in words, such as `Force 5 sea, waves 1.9 m high`. */
  words: string;
}

/** A point of the sea: x (east) and z (south) in metres. */
export type SeaPoint = [x: number, z: number];

/**
 * The element `<sea-state>`. Attributes: `state` (a state string or link), `ui` (`mini`, `0` or `1`), `src` (address of
 * a page of Seastate; without it, the one beside sea-state.js) and `loading` (`lazy` or `eager`).
 */
export class SeaState extends HTMLElement {
  /** Resolves when the first picture of the sea is drawn. */
  readonly ready: Promise<void>;
  /** The state string that the sea last told. */
  readonly state: string;
  /** The sea in words, as last told. */
  readonly words: string;
  /** Sets the sea: a state string or a link. Resolves with the state that the sea then has. */
  setState(state: string): Promise<string>;
  /** Asks for the state string at this moment. */
  getState(): Promise<string>;
  /** Heights of the sea above the still water, m, at up to 1000 points and a simulated time, s (without one: now). */
  heights(points: SeaPoint[], time?: number): Promise<number[]>;

  addEventListener<K extends keyof SeaStateEvents>(
    type: K,
    listener: (this: SeaState, event: SeaStateEvents[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

/** Events of the element. */
export interface SeaStateEvents {
  /** The first picture is drawn. */
  ready: CustomEvent<SeaDescription>;
  /** Somebody has changed the sea or the camera; the running time alone is no change. */
  change: CustomEvent<SeaDescription>;
  /** The sea could not be loaded or set. */
  error: CustomEvent<Error>;
}

/** Messages to the frame, for pages that use an iframe without the element. `id` is any number; the answer has it, too. */
export type SeaCall = { seastate: 1; id: number } & (
  | { call: 'listen' }
  | { call: 'getState' }
  | { call: 'setState'; state: string }
  | { call: 'heights'; points: SeaPoint[]; time?: number }
);

/** Messages from the frame. */
export type SeaMessage =
  | { seastate: 1; id: number; value: SeaDescription | string | number[] }
  | { seastate: 1; id: number; error: string }
  | ({ seastate: 1; event: 'change' } & SeaDescription);

declare global {
  interface HTMLElementTagNameMap {
    'sea-state': SeaState;
  }
}
