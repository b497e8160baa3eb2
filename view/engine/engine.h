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

/// The number of fields of the last task or evaluation.
int engine_fields();
const char* engine_field_name(int field);
/// 'n': a number, 'N': numbers, 't': a text, 'T': texts.
int engine_field_kind(int field);
int engine_field_size(int field);               ///< the number of numbers or texts
const double* engine_field_numbers(int field);  ///< all numbers of a field
const char* engine_field_text(int field, int i);
}
