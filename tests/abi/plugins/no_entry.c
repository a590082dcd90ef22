/* A shared object, but no plugin. */
__attribute__((visibility("default"))) int some_library_function(void);
int some_library_function(void) {
  return 1;
}
