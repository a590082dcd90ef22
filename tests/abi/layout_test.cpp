// The layout of every struct in the ABI on LP64 machines, pinned: a member that moves breaks every
// plugin that is out there. New members go to the end; then a line and a size change here.
#include <cstddef>

#include "lockstep/ext/changes.h"
#include "lockstep/ext/ticks.h"
#include "lockstep/leaf.h"

#if defined(__LP64__)

#define SIZE_IS(type, size) static_assert(sizeof(type) == (size))
#define MEMBER_AT(type, member, offset) static_assert(offsetof(type, member) == (offset))

SIZE_IS(bool, 1);
SIZE_IS(lockstep_status, 4);
SIZE_IS(lockstep_leaf_kind, 4);
SIZE_IS(lockstep_type, 4);
SIZE_IS(lockstep_direction, 4);
SIZE_IS(lockstep_log_level, 4);

SIZE_IS(lockstep_port, 88);
MEMBER_AT(lockstep_port, struct_size, 0);
MEMBER_AT(lockstep_port, type, 4);
MEMBER_AT(lockstep_port, direction, 8);
MEMBER_AT(lockstep_port, name, 16);
MEMBER_AT(lockstep_port, default_value, 24);
MEMBER_AT(lockstep_port, unit, 32);
MEMBER_AT(lockstep_port, doc, 40);
MEMBER_AT(lockstep_port, choices, 48);
MEMBER_AT(lockstep_port, min, 56);
MEMBER_AT(lockstep_port, max, 64);
MEMBER_AT(lockstep_port, object, 72);
MEMBER_AT(lockstep_port, flags, 80);

SIZE_IS(lockstep_object_type, 80);
MEMBER_AT(lockstep_object_type, struct_size, 0);
MEMBER_AT(lockstep_object_type, name, 8);
MEMBER_AT(lockstep_object_type, retain, 16);
MEMBER_AT(lockstep_object_type, release, 24);
MEMBER_AT(lockstep_object_type, to_text, 32);
MEMBER_AT(lockstep_object_type, from_text, 40);
MEMBER_AT(lockstep_object_type, to_bytes, 48);
MEMBER_AT(lockstep_object_type, from_bytes, 56);
MEMBER_AT(lockstep_object_type, why_no_object, 64);
MEMBER_AT(lockstep_object_type, reads, 72);

SIZE_IS(lockstep_text, 16);
MEMBER_AT(lockstep_text, text, 0);
MEMBER_AT(lockstep_text, length, 8);

SIZE_IS(lockstep_entry_value, 80);
MEMBER_AT(lockstep_entry_value, struct_size, 0);
MEMBER_AT(lockstep_entry_value, type, 4);
MEMBER_AT(lockstep_entry_value, declared, 8);
MEMBER_AT(lockstep_entry_value, flag, 12);
MEMBER_AT(lockstep_entry_value, whole, 16);
MEMBER_AT(lockstep_entry_value, number, 24);
MEMBER_AT(lockstep_entry_value, items, 32);
MEMBER_AT(lockstep_entry_value, count, 40);
MEMBER_AT(lockstep_entry_value, object, 48);
MEMBER_AT(lockstep_entry_value, object_type, 56);
MEMBER_AT(lockstep_entry_value, object_name, 64);
MEMBER_AT(lockstep_entry_value, writes, 72);

SIZE_IS(lockstep_lasting, 24);
MEMBER_AT(lockstep_lasting, struct_size, 0);
MEMBER_AT(lockstep_lasting, constant, 8);
MEMBER_AT(lockstep_lasting, is_set, 16);

SIZE_IS(lockstep_boards, 128);
MEMBER_AT(lockstep_boards, struct_size, 0);
MEMBER_AT(lockstep_boards, of, 8);
MEMBER_AT(lockstep_boards, of_port, 16);
MEMBER_AT(lockstep_boards, at, 24);
MEMBER_AT(lockstep_boards, release, 32);
MEMBER_AT(lockstep_boards, index, 40);
MEMBER_AT(lockstep_boards, is_over, 48);
MEMBER_AT(lockstep_boards, parent, 56);
MEMBER_AT(lockstep_boards, lock, 64);
MEMBER_AT(lockstep_boards, unlock, 72);
MEMBER_AT(lockstep_boards, try_lock, 80);
MEMBER_AT(lockstep_boards, home, 88);
MEMBER_AT(lockstep_boards, read, 96);
MEMBER_AT(lockstep_boards, write, 104);
MEMBER_AT(lockstep_boards, unset, 112);
MEMBER_AT(lockstep_boards, each, 120);

SIZE_IS(lockstep_host, 240);
MEMBER_AT(lockstep_host, abi_major, 0);
MEMBER_AT(lockstep_host, abi_minor, 4);
MEMBER_AT(lockstep_host, struct_size, 8);
MEMBER_AT(lockstep_host, name, 16);
MEMBER_AT(lockstep_host, version, 24);
MEMBER_AT(lockstep_host, get_bool, 32);
MEMBER_AT(lockstep_host, get_int, 40);
MEMBER_AT(lockstep_host, get_double, 48);
MEMBER_AT(lockstep_host, get_string, 56);
MEMBER_AT(lockstep_host, get_double_list, 64);
MEMBER_AT(lockstep_host, set_bool, 72);
MEMBER_AT(lockstep_host, set_int, 80);
MEMBER_AT(lockstep_host, set_double, 88);
MEMBER_AT(lockstep_host, set_string, 96);
MEMBER_AT(lockstep_host, set_double_list, 104);
MEMBER_AT(lockstep_host, set_error, 112);
MEMBER_AT(lockstep_host, now, 120);
MEMBER_AT(lockstep_host, tick_period, 128);
MEMBER_AT(lockstep_host, random_bits, 136);
MEMBER_AT(lockstep_host, random, 144);
MEMBER_AT(lockstep_host, log, 152);
MEMBER_AT(lockstep_host, get_extension, 160);
MEMBER_AT(lockstep_host, get_int_list, 168);
MEMBER_AT(lockstep_host, get_bool_list, 176);
MEMBER_AT(lockstep_host, get_string_list, 184);
MEMBER_AT(lockstep_host, set_int_list, 192);
MEMBER_AT(lockstep_host, set_bool_list, 200);
MEMBER_AT(lockstep_host, set_string_list, 208);
MEMBER_AT(lockstep_host, get_object, 216);
MEMBER_AT(lockstep_host, set_object, 224);
MEMBER_AT(lockstep_host, set_empty_port, 232);

SIZE_IS(lockstep_leaf_type, 200);
MEMBER_AT(lockstep_leaf_type, struct_size, 0);
MEMBER_AT(lockstep_leaf_type, kind, 4);
MEMBER_AT(lockstep_leaf_type, id, 8);
MEMBER_AT(lockstep_leaf_type, doc, 16);
MEMBER_AT(lockstep_leaf_type, port_count, 24);
MEMBER_AT(lockstep_leaf_type, ports, 32);
MEMBER_AT(lockstep_leaf_type, create, 40);
MEMBER_AT(lockstep_leaf_type, destroy, 48);
MEMBER_AT(lockstep_leaf_type, start, 56);
MEMBER_AT(lockstep_leaf_type, tick, 64);
MEMBER_AT(lockstep_leaf_type, halt, 72);
MEMBER_AT(lockstep_leaf_type, pause, 80);
MEMBER_AT(lockstep_leaf_type, resume, 88);
MEMBER_AT(lockstep_leaf_type, progress, 96);
MEMBER_AT(lockstep_leaf_type, get_extension, 104);
MEMBER_AT(lockstep_leaf_type, flags, 112);
MEMBER_AT(lockstep_leaf_type, min_children, 120);
MEMBER_AT(lockstep_leaf_type, max_children, 124);
MEMBER_AT(lockstep_leaf_type, start_unreset, 128);
MEMBER_AT(lockstep_leaf_type, behavior_count, 136);
MEMBER_AT(lockstep_leaf_type, behavior, 144);
MEMBER_AT(lockstep_leaf_type, more_ports, 152);
MEMBER_AT(lockstep_leaf_type, describe, 160);
MEMBER_AT(lockstep_leaf_type, data, 168);
MEMBER_AT(lockstep_leaf_type, set_pace, 176);
MEMBER_AT(lockstep_leaf_type, save, 184);
MEMBER_AT(lockstep_leaf_type, restore, 192);

SIZE_IS(lockstep_cut, 24);
MEMBER_AT(lockstep_cut, struct_size, 0);
MEMBER_AT(lockstep_cut, power, 4);
MEMBER_AT(lockstep_cut, held, 5);
MEMBER_AT(lockstep_cut, on_resume, 6);
MEMBER_AT(lockstep_cut, gap, 8);
MEMBER_AT(lockstep_cut, lost_ticks, 16);

SIZE_IS(lockstep_fixed, 16);
MEMBER_AT(lockstep_fixed, port, 0);
MEMBER_AT(lockstep_fixed, text, 8);

SIZE_IS(lockstep_refusal, 32);
MEMBER_AT(lockstep_refusal, struct_size, 0);
MEMBER_AT(lockstep_refusal, port, 8);
MEMBER_AT(lockstep_refusal, message, 16);
MEMBER_AT(lockstep_refusal, hint, 24);
SIZE_IS(lockstep_behavior, 16);
MEMBER_AT(lockstep_behavior, word, 0);
MEMBER_AT(lockstep_behavior, value, 8);

SIZE_IS(lockstep_workers, 64);
MEMBER_AT(lockstep_workers, struct_size, 0);
MEMBER_AT(lockstep_workers, begin, 8);
MEMBER_AT(lockstep_workers, finish, 16);
MEMBER_AT(lockstep_workers, start, 24);
MEMBER_AT(lockstep_workers, wait, 32);
MEMBER_AT(lockstep_workers, end, 40);
MEMBER_AT(lockstep_workers, now, 48);
MEMBER_AT(lockstep_workers, wake, 56);

SIZE_IS(lockstep_children, 64);
MEMBER_AT(lockstep_children, struct_size, 0);
MEMBER_AT(lockstep_children, count, 8);
MEMBER_AT(lockstep_children, tick, 16);
MEMBER_AT(lockstep_children, halt, 24);
MEMBER_AT(lockstep_children, pause, 32);
MEMBER_AT(lockstep_children, status, 40);
MEMBER_AT(lockstep_children, progress, 48);
MEMBER_AT(lockstep_children, tick_unreset, 56);

SIZE_IS(lockstep_changes, 16);
MEMBER_AT(lockstep_changes, struct_size, 0);
MEMBER_AT(lockstep_changes, changed, 8);

SIZE_IS(lockstep_ticks, 16);
MEMBER_AT(lockstep_ticks, struct_size, 0);
MEMBER_AT(lockstep_ticks, number, 8);

SIZE_IS(lockstep_place, 128);
MEMBER_AT(lockstep_place, struct_size, 0);
MEMBER_AT(lockstep_place, name, 8);
MEMBER_AT(lockstep_place, path, 16);
MEMBER_AT(lockstep_place, id, 24);
MEMBER_AT(lockstep_place, child_id, 32);
MEMBER_AT(lockstep_place, child_name, 40);
MEMBER_AT(lockstep_place, given, 48);
MEMBER_AT(lockstep_place, value_type, 56);
MEMBER_AT(lockstep_place, get_object, 64);
MEMBER_AT(lockstep_place, set_object, 72);
MEMBER_AT(lockstep_place, open, 80);
MEMBER_AT(lockstep_place, unset, 88);
MEMBER_AT(lockstep_place, ask_for_tick, 96);
MEMBER_AT(lockstep_place, wake, 104);
MEMBER_AT(lockstep_place, data, 112);
MEMBER_AT(lockstep_place, language, 120);

SIZE_IS(lockstep_words, 24);
MEMBER_AT(lockstep_words, struct_size, 0);
MEMBER_AT(lockstep_words, count, 4);
MEMBER_AT(lockstep_words, words, 8);
MEMBER_AT(lockstep_words, numbers, 16);

SIZE_IS(lockstep_plugin, 104);
MEMBER_AT(lockstep_plugin, abi_major, 0);
MEMBER_AT(lockstep_plugin, abi_minor, 4);
MEMBER_AT(lockstep_plugin, struct_size, 8);
MEMBER_AT(lockstep_plugin, name, 16);
MEMBER_AT(lockstep_plugin, version, 24);
MEMBER_AT(lockstep_plugin, doc, 32);
MEMBER_AT(lockstep_plugin, leaf_type_count, 40);
MEMBER_AT(lockstep_plugin, leaf_types, 48);
MEMBER_AT(lockstep_plugin, init, 56);
MEMBER_AT(lockstep_plugin, deinit, 64);
MEMBER_AT(lockstep_plugin, create_run, 72);
MEMBER_AT(lockstep_plugin, destroy_run, 80);
MEMBER_AT(lockstep_plugin, get_extension, 88);
MEMBER_AT(lockstep_plugin, describe, 96);

#endif

// What plugins have compiled into them as numbers.
static_assert(LOCKSTEP_RUNNING == 1 && LOCKSTEP_SUCCESS == 2 && LOCKSTEP_FAILURE == 3);
static_assert(LOCKSTEP_IDLE == 0);
static_assert(LOCKSTEP_ACTION == 1 && LOCKSTEP_CONDITION == 2);
static_assert(LOCKSTEP_CONTROL == 3 && LOCKSTEP_DECORATOR == 4);
static_assert(LOCKSTEP_REAL_TIME == 1 && LOCKSTEP_MAY_RUN == 2 && LOCKSTEP_OPENS == 4 &&
              LOCKSTEP_AT_ONCE == 8);
static_assert(LOCKSTEP_HALTS_CHILDREN == 16);
static_assert(LOCKSTEP_BOOL == 1 && LOCKSTEP_INT == 2 && LOCKSTEP_DOUBLE == 3);
static_assert(LOCKSTEP_STRING == 4 && LOCKSTEP_DOUBLE_LIST == 5);
static_assert(LOCKSTEP_INT_LIST == 6 && LOCKSTEP_BOOL_LIST == 7 && LOCKSTEP_STRING_LIST == 8);
static_assert(LOCKSTEP_OBJECT == 9);
static_assert(LOCKSTEP_NUMBER == 100 && LOCKSTEP_ANY == 101);
static_assert(LOCKSTEP_OPTIONAL == 1 && LOCKSTEP_DEFAULT_ENTRY == 2);
static_assert(LOCKSTEP_INPUT == 1 && LOCKSTEP_OUTPUT == 2 && LOCKSTEP_INOUT == 3);
static_assert(LOCKSTEP_LOG_DEBUG == 0 && LOCKSTEP_LOG_INFO == 1 && LOCKSTEP_LOG_WARNING == 2);
