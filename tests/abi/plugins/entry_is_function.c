__attribute__((visibility("default"))) const void* lockstep_plugin_entry(void);
const void* lockstep_plugin_entry(void) {
  return 0;
}
