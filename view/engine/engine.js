// Evaluates tasks by the WebAssembly module of this folder; README.md describes what it returns.
async function createEngine(wasm) {
  const fail = (why) => { throw new Error(why); };
  const packed = new Uint8Array(wasm)[0] === 0x1f;
  const unpack = (bytes) => new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  const module = await WebAssembly.compile(packed ? await unpack(wasm) : wasm);
  // The C library names a few calls of an operating system. There is none.
  const imports = {};
  for (const {module: from, name} of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] = name === "proc_exit" ? () => fail("engine: ended early") : () => 52;
  }
  const c = (await WebAssembly.instantiate(module, imports)).exports;
  c._initialize();
  const encoder = new TextEncoder(), decoder = new TextDecoder();

  const text = (at) => {
    const bytes = new Uint8Array(c.memory.buffer, at);
    return decoder.decode(bytes.slice(0, bytes.indexOf(0)));
  };
  // Calls a function with copies of typed arrays in the module's memory, and their sizes.
  const call = (name, ...values) => {
    const copies = [];
    const copy = (array) => {
      const at = c.malloc(array.byteLength + 8);
      copies.push(at);
      new Uint8Array(c.memory.buffer).set(
        new Uint8Array(array.buffer, array.byteOffset, array.byteLength), at);
      return at;
    };
    const words = values.flatMap((value) => {
      if (typeof value === "string") return [copy(encoder.encode(value + "\0"))];
      return ArrayBuffer.isView(value) ? [copy(value), value.length] : [value];
    });
    let error;
    try {
      error = c[name](...words);
    } catch (trap) {
      fail("engine: " + trap.message);
    }
    copies.forEach((at) => c.free(at));
    if (error) fail(text(error));
    return fields();
  };
  const fields = () => {
    const result = {};
    for (let i = 0; i < c.engine_fields(); ++i) {
      const kind = String.fromCharCode(c.engine_field_kind(i)), size = c.engine_field_size(i);
      const all = kind.toLowerCase() === "t"
        ? Array.from({length: size}, (_, k) => text(c.engine_field_text(i, k)))
        : new Float64Array(c.memory.buffer, c.engine_field_numbers(i), size).slice();
      result[text(c.engine_field_name(i))] = kind === "n" || kind === "t" ? all[0] : all;
    }
    return result;
  };
  const numbers = (key, values) => {
    if (values && typeof values !== "string" && values.length >= 0) return Float64Array.from(values);
    return fail(`${key}: got ${values}, expected a list of numbers`);
  };

  const engine = {
    load(bytes) {
      const {measure_names, measure_summaries, measure_units, measure_any, ...task} =
        call("engine_load", bytes instanceof Uint8Array ? bytes : new Uint8Array(bytes));
      task.measures = measure_names.map((name, i) => ({
        name, summary: measure_summaries[i], unit: measure_units[i],
        wrench: measure_any[i] ? ["pure", "any"] : ["pure"]}));
      return task;
    },
    evaluate(theta_r, {measure = "linf_polytope", wrench = "pure", collision = true, solution} = {}) {
      const near = solution?.near === undefined ? [] : numbers("near", solution.near);
      const number = typeof solution === "object" ? -1 : solution ?? -1;
      if (!Number.isInteger(number) || (solution === number && number < 0)) {
        fail(`solution: got ${solution}, expected a number of a solution or {near}`);
      }
      return call("engine_evaluate", numbers("theta_r", theta_r), String(measure), String(wrench),
        collision ? 1 : 0, number, Float64Array.from(near));
    },
    evaluateKnots(knots, {measure = "linf_polytope", wrench = "pure", collision = true} = {}) {
      if (!Array.isArray(knots)) fail(`knots: got ${knots}, expected a list of lists of numbers`);
      call("engine_evaluate_knots", Float64Array.from(knots.flatMap((knot) => Array.from(numbers("knots", knot)))),
        String(measure), String(wrench), collision ? 1 : 0);
      return engine.part("shown");
    },
    part(name, instant = 0) {
      return JSON.parse(call("engine_part", String(name), instant).json);
    },
    solutions(theta_r, options = {}) {
      const best = engine.evaluate(theta_r, {...options, solution: undefined});
      return Array.from({length: best.solutions},
        (_, i) => i === best.solution ? best : engine.evaluate(theta_r, {...options, solution: i}));
    },
  };
  return engine;
}
if (typeof module === "object") module.exports = {createEngine};
