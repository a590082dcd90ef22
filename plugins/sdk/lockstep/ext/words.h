/* lockstep/ext/words.h: words that scripts know as numbers. */
#ifndef LOCKSTEP_EXT_WORDS_H
#define LOCKSTEP_EXT_WORDS_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Words of a plugin that scripts know as numbers, in trees for BehaviorTree.CPP. Found
 * with lockstep_plugin::get_extension(LOCKSTEP_WORDS), which `lockstep check` calls too; not of a
 * plugin in a separate process. Both lists are valid until the end of the process. */
typedef struct lockstep_words {
  uint32_t struct_size;
  uint32_t count;
  const char* const* words;
  const double* numbers;
} lockstep_words;

#define LOCKSTEP_WORDS "lockstep.words"

#ifdef __cplusplus
}
#endif

#endif
