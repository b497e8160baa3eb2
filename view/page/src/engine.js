// The evaluation of postures in the page, if the command put the engine and the task into it.
import { bytesOf } from "./bytes.js";
import { byId } from "./dom.js";

/** What evaluates postures of the scene's measure and wrench; null without an engine. */
export async function engineOf(scene) {
  const module = byId("engine-module");
  if (!module) return null;
  const engine = await globalThis.createEngine(bytesOf(module.textContent));
  const task = engine.load(bytesOf(byId("engine-task").textContent));
  const measure = task.measures.find(({ name }) => name === scene.measure);
  if (!measure?.wrench.includes(scene.wrench)) return null;
  const options = { measure: scene.measure, wrench: scene.wrench };
  return {
    /** The posture on the IK solution nearest to the joints `near`. */
    evaluate: (theta, near) => engine.evaluate(theta, { ...options, solution: { near } }),
    solutions: (theta) => engine.solutions(theta, options),
  };
}
