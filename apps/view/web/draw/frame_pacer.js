// SPDX-License-Identifier: Apache-2.0
//
// When frames are drawn, and how well. Without a graphics card a frame may take a second, and frames that are
// asked for meanwhile would queue: the page would show what was long ago. So a frame begins only when the one before is on
// the screen, and where frames take long, they are drawn in fewer triangles and fewer pixels until nothing moves any more.

const FRAME_TIME = 25; // milliseconds that a frame may take while something moves
const FRAME_SHARES = [1, 0.7, 0.5, 0.35, 0.25]; // of the pixels of a side
const FRAME_LOOK = 2; // milliseconds
// Once nothing moves: after so many milliseconds, what surely takes no longer than so many. Who moves on waits for it.
const FRAME_REST = [{ after: 200, takes: 400 }, { after: 1200, takes: Infinity }];

export class FramePacer {
  // draw(share, coarse) draws a frame with that share of the pixels of a side, whole or in few triangles; isLarge():
  // whether the latter are fewer.
  constructor(gl, { draw, isLarge }) {
    Object.assign(this, { gl, draw, isLarge });
    this.share = 1; // of the next frame
    this.coarse = false; // the next frame
    this.whole = { share: 1, took: 0 }; // the last frame that was whole
    this.wanted = false;
    this.busy = false; // a frame is asked for or being drawn
    this.slow = 0; // frames in a row that took too long
    this.waiting = [];
  }

  // A frame as soon as that is possible.
  request() {
    this.wanted = true;
    clearTimeout(this.resting);
    if (!this.busy) this.#begin();
  }

  // Ends when what was asked for is on the screen.
  shown() {
    return this.busy ? new Promise((done) => this.waiting.push(done)) : Promise.resolve();
  }

  // Somebody has drawn a frame in all pixels himself.
  drawn() {
    clearTimeout(this.resting);
  }

  #begin() {
    this.busy = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      this.#frame(this.share, this.coarse && this.isLarge(), 0);
    });
  }

  // rest: the entry of FRAME_REST that comes next.
  #frame(share, coarse, rest) {
    const { gl } = this;
    const begin = performance.now();
    this.busy = true;
    this.draw(share, coarse);
    const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      if (!gl.isContextLost() && gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED) {
        setTimeout(look, FRAME_LOOK);
        return;
      }
      gl.deleteSync(sync);
      this.busy = false;
      this.#end({ share, coarse, took: performance.now() - begin }, rest);
    };
    setTimeout(look);
  }

  #end(frame, rest) {
    const { share, coarse, took } = frame;
    if (!coarse) this.whole = frame;
    if (rest === 0) {
      this.slow = took > 1.5 * FRAME_TIME ? this.slow + 1 : 0;
      // The first frame of something large may take long on any card.
      if (this.slow > 1) {
        if (!coarse && this.isLarge()) this.coarse = true;
        else this.share = fitting(frame, FRAME_TIME);
      } else if (took < FRAME_TIME / 3 && share < 1) {
        this.share = FRAME_SHARES[FRAME_SHARES.indexOf(share) - 1];
      }
    } else if (took < FRAME_TIME && share === 1) {
      this.coarse = false; // what was slow is over
    }
    if (this.wanted) {
      this.#begin();
      return;
    }
    for (const done of this.waiting.splice(0)) done();
    if ((share === 1 && !coarse) || rest === FRAME_REST.length) return;
    const { after, takes } = FRAME_REST[rest];
    this.resting = setTimeout(() => this.#frame(fitting(this.whole, takes), false, rest + 1), after);
  }
}

// The largest share in which what took so long should take at most so many milliseconds.
function fitting({ share, took }, milliseconds) {
  return FRAME_SHARES.find((one) => took * (one / share) ** 2 <= milliseconds) ?? FRAME_SHARES.at(-1);
}
