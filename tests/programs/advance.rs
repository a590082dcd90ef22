//! The leaf of the door's tree in Rust, over the bindings that `lockstep new plugin --lang rust` copies.
#[allow(dead_code)]
mod lockstep;
use lockstep::{Action, Here, LeafType, Plugin, Port, Status, Type};

struct Advance {
    here: Here,
    done: f64,
}

impl Action for Advance {
    fn new(here: Here) -> Self {
        Advance { here, done: 0.0 }
    }

    fn start(&mut self) {
        self.done = 0.0;
    }

    fn tick(&mut self) -> Status {
        let step = self.here.double(0);
        assert!(step != 0.0, "port 'step' is 0: there is no way to go");
        self.done = (self.done + step).clamp(0.0, 1.0);
        if self.done >= 1.0 - 1e-9 {
            Status::Success
        } else {
            Status::Running
        }
    }

    fn progress(&mut self) -> f64 {
        self.done
    }
}

static STEP: Port = Port::input(Type::Double, text!("step")).or(text!("0.01")).doc(text!("what a tick adds"));
static ADVANCE: LeafType = LeafType::of::<Advance>(text!("Advance"), text!("Goes on at a pace"), &[&STEP]);

#[no_mangle]
pub static lockstep_plugin_entry: Plugin =
    Plugin::of(text!("advance"), text!("Where to start a plugin in Rust"), &[&ADVANCE]);
