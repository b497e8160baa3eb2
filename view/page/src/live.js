// Postures and trajectories of the sliders, evaluated in the page.

const kQuick = 30; // ms: what takes longer waits until a slider rests
const kRest = 120; // ms

export class Live {
  /** `engine` may be null: then there are only the frames of the scene. `rested` is called when a slider has rested. */
  constructor(scene, engine, rested) {
    this.scene = scene;
    this.engine = engine;
    this.rested = rested;
    this.cost = { trajectory: 0, details: 0, sets: 0 };
    this.own = null; // as an entry of the scene
  }

  timed(what, run) {
    const start = performance.now();
    const result = run();
    this.cost[what] = performance.now() - start;
    return result;
  }

  later(run) {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(run, kRest);
  }

  /** Evaluates a posture on the IK solution nearest to the joints `near`. */
  move(theta, near) {
    const frame = this.engine.evaluate(theta, near);
    this.own = { name: "own", frames: [frame], beta: frame.beta, unit: frame.unit, status: frame.status, explanation: this.own?.explanation, scenarios: this.own?.scenarios };
    this.own.stale = true;
    if (this.cost.details < kQuick) this.details();
    this.later(() => {
      if (this.own.stale) this.details();
      this.rested();
    });
    return this.own;
  }

  /** What else is shown of the posture of `move`. */
  details() {
    const { own, engine } = this;
    this.timed("details", () => {
      const frame = own.frames[0];
      engine.evaluate(frame.theta_r, frame.theta); // others may have been evaluated since
      frame.sets = engine.part("sets");
      own.explanation = engine.part("explanation");
      own.scenarios = engine.part("scenarios");
    });
    own.stale = false;
  }

  /** The IK solutions of a posture. */
  solutions(frame) {
    return this.engine.solutions(frame.theta_r);
  }

  /** Evaluates a table of knots, at once or when the slider rests; `done` gets the entry. */
  moveKnots(knots, done) {
    const run = () => {
      this.own = { ...this.timed("trajectory", () => this.engine.trajectory(knots)), name: "own" };
      if (this.own.frames.length) done(this.own);
    };
    if (this.cost.trajectory < kQuick) run();
    else this.later(run);
  }

  /** Gives a frame of a trajectory the sets of wrenches of the nearest instant, if they are known or quickly computed; else of another one. */
  findSets(entry, frame, patient) {
    const instant = frame.near;
    if (instant.sets === undefined && this.engine && (patient || this.cost.sets < kQuick)) {
      instant.sets = this.timed("sets", () => this.engine.setsAt(entry, instant.instant));
    }
    frame.setsOf = instant;
    if (instant.sets === undefined) {
      const apart = (other) => Math.abs(other.t - frame.t);
      frame.setsOf = entry.frames.filter((other) => other.sets !== undefined).reduce((a, b) => (a && apart(a) <= apart(b) ? a : b), null);
    }
    frame.sets = frame.setsOf?.sets ?? null;
  }
}
