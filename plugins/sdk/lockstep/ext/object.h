/* lockstep/ext/object.h: objects that ports carry by reference. */
#ifndef LOCKSTEP_EXT_OBJECT_H
#define LOCKSTEP_EXT_OBJECT_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A type of objects that ports carry by reference. What is carried does not change. Two
 * types of one name are one, also of different plugins: each may get what the other has made, so
 * the name stands for the layout of the object in memory. Declare each type once in a plugin. */
struct lockstep_object_type {
  uint32_t struct_size; /* sizeof(lockstep_object_type) as the plugin knew it */
  const char* name;     /* "nav.Path": up to 100 letters, digits and '._:/-'; inside also spaces and
                           '<>,*&()[]', as in the name of a C++ type */

  /* [any] One reference more; one less, and with the last the end of the object. A reference that a
   * leaf has set is released in a function of the run, at the latest before destroy_run. */
  void (*retain)(void* object);
  void (*release)(void* object);

  /* [any] (optional) For recordings and views: writes at most `size` bytes of the text, without a
   * NUL, and returns how many bytes the whole text has. */
  size_t (*to_text)(const void* object, char* text, size_t size);
  /* [any] (optional) For constants in a tree: a new object with one reference, or NULL when the
   * text is none. It must not need init: `lockstep check` calls it too. Such an object belongs to
   * the tree, whose runs share it, and is released when the tree is. */
  void* (*from_text)(const char* text, size_t length);

  /* [any] (optional, both or none) For plugins in separate processes, which exchange bytes. Writes
   * at most `size` bytes and returns how many the whole object has, at most 64 MiB; SIZE_MAX when
   * it does not know it. */
  size_t (*to_bytes)(const void* object, void* bytes, size_t size);
  /* A new object with one reference, or NULL when the bytes are none. Another process has written
   * them, which may run another version of the plugin: check them. */
  void* (*from_bytes)(const void* bytes, size_t length);

  /* [any] (optional) Why the last from_text of this thread returned NULL, in a sentence; NULL when
   * there is no more text. Valid until the next from_text. */
  const char* (*why_no_object)(void);

  /* (optional) Whether an input of this type may be bound to an entry of the type of
   * that name. The leaf gets such an object by lockstep_place::get_object, with that type, and
   * makes of it what it needs. */
  bool (*reads)(const char* name);
};

#ifdef __cplusplus
}
#endif

#endif
