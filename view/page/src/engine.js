// The evaluation of postures and trajectories in the page, if the command put the engine and the task into it.
import { bytesOf } from "./bytes.js";
import { byId } from "./dom.js";

/** What evaluates the scene's measure and wrench; null without an engine. */
export async function engineOf(scene) {
  const module = byId("engine-module");
  if (!module) return null;
  const engine = await globalThis.createEngine(bytesOf(module.textContent));
  const task = engine.load(bytesOf(byId("engine-task").textContent));
  const measure = task.measures.find(({ name }) => name === scene.measure);
  if (!measure?.wrench.includes(scene.wrench)) return null;
  const options = { measure: scene.measure, wrench: scene.wrench };
  let last = null; // the trajectory that was evaluated last
  return {
    /** The posture on the IK solution nearest to the joints `near`. */
    evaluate: (theta, near) => engine.evaluate(theta, { ...options, solution: { near } }),
    solutions: (theta) => engine.solutions(theta, options),
    /** Of the posture that was evaluated last: "sets", "explanation" or "scenarios". */
    part: (name) => engine.part(name),
    /** The trajectory of a table of knots, as a scene has it, without sets of wrenches. */
    trajectory(knots) {
      last = null;
      return (last = engine.evaluateKnots(knots, options));
    },
    /** The sets of wrenches at an instant of a trajectory. */
    setsAt(trajectory, instant) {
      if (trajectory !== last) engine.evaluateKnots(trajectory.knots, options);
      last = trajectory;
      return engine.part("sets", instant);
    },
  };
}
