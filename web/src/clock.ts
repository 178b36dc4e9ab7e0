// Where the player is in the run. Time is a place between frames: 3.25 lies a quarter of the way from frame 3 to 4.
export interface Clock {
  readonly place: number;
  readonly frame: number;
  readonly playing: boolean;
  /** Seconds on the wall for the whole run. */
  duration: number;
  seek: (place: number) => void;
  seekTime: (seconds: number) => void;
  time: () => number;
  play: () => void;
  pause: () => void;
}

/** `tick` is called after every change of place or state. */
export function makeClock(times: number[], tick: () => void): Clock {
  const last = Math.max(0, times.length - 1);
  let place = 0;
  let playing = false;
  let before = 0;
  const span = times[last] - times[0];

  const timeAt = (p: number) => {
    const k = Math.min(Math.floor(p), Math.max(0, last - 1));
    return last === 0 ? times[0] ?? 0 : times[k] + (p - k) * (times[k + 1] - times[k]);
  };
  const placeAt = (time: number) => {
    let k = 0;
    while (k < last - 1 && times[k + 1] <= time) ++k;
    if (last === 0) return 0;
    return Math.min(last, Math.max(0, k + (time - times[k]) / (times[k + 1] - times[k])));
  };

  const clock = {
    duration: 12,
    get place() {
      return place;
    },
    get frame() {
      return Math.min(last, Math.floor(place + 1e-9));
    },
    get playing() {
      return playing;
    },
    seek(p: number) {
      place = Math.min(last, Math.max(0, p));
      tick();
    },
    seekTime(seconds: number) {
      clock.seek(playing ? placeAt(seconds) : Math.round(placeAt(seconds)));
    },
    time: () => timeAt(place),
    play() {
      if (playing || last === 0) return;
      if (place >= last) place = 0;
      playing = true;
      before = performance.now();
      requestAnimationFrame(advance);
      tick();
    },
    /** Comes to rest on a frame, so that what is read is what was computed. */
    pause() {
      playing = false;
      place = Math.round(place);
      tick();
    },
  };

  function advance(now: number) {
    if (!playing) return;
    const seconds = Math.min(0.25, (now - before) / 1000);
    before = now;
    const next = placeAt(timeAt(place) + (seconds / clock.duration) * span);
    if (next >= last) {
      place = last;
      clock.pause();
      return;
    }
    place = next;
    tick();
    requestAnimationFrame(advance);
  }
  return clock;
}
