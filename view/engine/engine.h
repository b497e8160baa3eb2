#pragma once

/// @file
/// The functions of the WebAssembly module, which engine.js calls.
///
/// Texts are UTF-8 and end with a zero. A function that can fail returns one line that says why, or
/// null. What a pointer refers to is valid until the next call of one that can fail.

extern "C" {

/// Reads a task that `problem_data` wrote. The fields then describe it.
const char* engine_load(const char* data, int size);

/// Evaluates the task. The fields then are the evaluation.
///
/// @param theta_r    the redundant coordinates
/// @param count      their number
/// @param measure    the name of the measure
/// @param wrench     "pure" or "any"
/// @param collision  whether postures that collide are invalid
/// @param solution   the number of the IK solution; -1: the best one, or the nearest
/// @param near       positions of all joints: the nearest IK solution is wanted
/// @param joints     their number; 0: none
const char* engine_evaluate(const double* theta_r, int count, const char* measure,
                            const char* wrench, int collision, int solution, const double* near,
                            int joints);

/// Evaluates a trajectory of a task in time. The result is in `engine_part`.
///
/// @param knots      the knots (k×r), one after the other
/// @param count      the number of numbers
/// @param measure, wrench, collision  as above
const char* engine_evaluate_knots(const double* knots, int count, const char* measure,
                                  const char* wrench, int collision);

/// Part of the last evaluation. The field "json" then is that part as a scene has it.
///
/// @param part     "shown", "sets", "explanation" or "scenarios"
/// @param instant  the number of the instant whose sets are wanted; 0 of a static task
const char* engine_part(const char* part, int instant);

/// The number of fields of the last task or evaluation.
int engine_fields();
const char* engine_field_name(int field);
/// 'n': a number, 'N': numbers, 't': a text, 'T': texts.
int engine_field_kind(int field);
int engine_field_size(int field);               ///< the number of numbers or texts
const double* engine_field_numbers(int field);  ///< all numbers of a field
const char* engine_field_text(int field, int i);
}
