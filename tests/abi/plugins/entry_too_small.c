__attribute__((visibility("default"))) extern const int lockstep_plugin_entry;
const int lockstep_plugin_entry = 1;
