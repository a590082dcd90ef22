//! lockstep/leaf.h for leaves in Rust: the tables of the contract, and a trait that an action has.
//! A host reads of a table only what its struct_size covers, and adds to its own at the end, so what
//! is not here is not missed.
use std::os::raw::{c_char, c_void};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::ptr::null;

#[repr(C)]
pub struct Caller {
    _opaque: [u8; 0],
}

type Unused = *const c_void;

/// lockstep_host up to `log`; functions that are not bound are `Unused`.
#[repr(C)]
pub struct Host {
    abi_major: u32,
    abi_minor: u32,
    struct_size: u32,
    name: *const c_char,
    version: *const c_char,
    get_bool: extern "C" fn(*const Caller, u32, *mut bool) -> bool,
    get_int: extern "C" fn(*const Caller, u32, *mut i64) -> bool,
    get_double: extern "C" fn(*const Caller, u32, *mut f64) -> bool,
    get_string: Unused,
    get_double_list: Unused,
    set_bool: extern "C" fn(*const Caller, u32, bool) -> bool,
    set_int: extern "C" fn(*const Caller, u32, i64) -> bool,
    set_double: extern "C" fn(*const Caller, u32, f64) -> bool,
    set_string: Unused,
    set_double_list: Unused,
    set_error: extern "C" fn(*const Caller, *const c_char),
    now: extern "C" fn(*const Caller) -> f64,
    tick_period: extern "C" fn(*const Caller) -> f64,
    random_bits: Unused,
    random: extern "C" fn(*const Caller) -> f64,
    log: extern "C" fn(*const Caller, i32, *const c_char),
}

#[repr(C)]
pub struct Port {
    pub struct_size: u32,
    pub kind: i32,
    pub direction: i32,
    pub name: *const c_char,
    pub default_value: *const c_char,
    pub unit: *const c_char,
    pub doc: *const c_char,
}
unsafe impl Sync for Port {}

#[repr(C)]
pub struct LeafType {
    pub struct_size: u32,
    pub kind: i32,
    pub id: *const c_char,
    pub doc: *const c_char,
    pub port_count: u32,
    pub ports: *const &'static Port,
    pub create: extern "C" fn(*const Host, *const Caller, *mut c_void) -> *mut c_void,
    pub destroy: extern "C" fn(*mut c_void),
    pub start: extern "C" fn(*mut c_void),
    pub tick: extern "C" fn(*mut c_void) -> i32,
    pub halt: extern "C" fn(*mut c_void),
    pub pause: extern "C" fn(*mut c_void),
    pub resume: extern "C" fn(*mut c_void),
    pub progress: extern "C" fn(*mut c_void) -> f64,
    pub get_extension: Unused,
}
unsafe impl Sync for LeafType {}

#[repr(C)]
pub struct Plugin {
    pub abi_major: u32,
    pub abi_minor: u32,
    pub struct_size: u32,
    pub name: *const c_char,
    pub version: *const c_char,
    pub doc: *const c_char,
    pub leaf_type_count: u32,
    pub leaf_types: *const &'static LeafType,
    pub unused: [Unused; 5], // init, deinit, create_run, destroy_run, get_extension
}
unsafe impl Sync for Plugin {}

/// A text of the tables.
#[macro_export]
macro_rules! text {
    ($text:literal) => {
        concat!($text, "\0").as_ptr() as *const std::os::raw::c_char
    };
}

#[derive(Clone, Copy)]
pub enum Status {
    Running = 1,
    Success = 2,
    Failure = 3,
}

/// The host, as one leaf sees it.
#[derive(Clone, Copy)]
pub struct Here {
    host: &'static Host,
    caller: *const Caller,
}

impl Here {
    /// The value of an input port of type double, by its index.
    pub fn double(&self, port: u32) -> f64 {
        let mut value = 0.0;
        if !(self.host.get_double)(self.caller, port, &mut value) {
            panic!("port {port} has no value");
        }
        value
    }
    pub fn set_double(&self, port: u32, value: f64) {
        (self.host.set_double)(self.caller, port, value);
    }
    pub fn now(&self) -> f64 {
        (self.host.now)(self.caller)
    }
    pub fn random(&self) -> f64 {
        (self.host.random)(self.caller)
    }
    pub fn log(&self, text: &str) {
        (self.host.log)(self.caller, 1, zero_ended(text).as_ptr() as *const c_char);
    }
    fn fail(&self, text: &str) {
        (self.host.set_error)(self.caller, zero_ended(text).as_ptr() as *const c_char);
    }
}

fn zero_ended(text: &str) -> Vec<u8> {
    text.bytes().filter(|byte| *byte != 0).chain([0]).collect()
}

pub trait Action: Sized {
    fn new(here: Here) -> Self;
    fn start(&mut self) {}
    fn tick(&mut self) -> Status;
    fn halt(&mut self) {}
    fn pause(&mut self) {}
    fn resume(&mut self) {}
    fn progress(&mut self) -> f64;
}

struct Leaf<A> {
    here: Here,
    action: A,
}

/// No panic crosses the contract: it is the leaf's error, with its text.
fn guarded<T>(here: Here, otherwise: T, call: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|it| it.to_string()));
        here.fail(&text.unwrap_or_else(|| "panicked".into()));
        otherwise
    })
}

fn call<A: Action, T>(leaf: *mut c_void, otherwise: T, function: fn(&mut A) -> T) -> T {
    let leaf = unsafe { &mut *(leaf as *mut Leaf<A>) };
    guarded(leaf.here, otherwise, || function(&mut leaf.action))
}

extern "C" fn create<A: Action>(host: *const Host, caller: *const Caller, _: *mut c_void) -> *mut c_void {
    let here = Here { host: unsafe { &*host }, caller };
    guarded(here, std::ptr::null_mut(), || {
        Box::into_raw(Box::new(Leaf { here, action: A::new(here) })) as *mut c_void
    })
}
extern "C" fn destroy<A: Action>(leaf: *mut c_void) {
    drop(unsafe { Box::from_raw(leaf as *mut Leaf<A>) });
}
extern "C" fn start<A: Action>(leaf: *mut c_void) {
    call(leaf, (), A::start)
}
extern "C" fn tick<A: Action>(leaf: *mut c_void) -> i32 {
    call(leaf, Status::Running, A::tick) as i32
}
extern "C" fn halt<A: Action>(leaf: *mut c_void) {
    call(leaf, (), A::halt)
}
extern "C" fn pause<A: Action>(leaf: *mut c_void) {
    call(leaf, (), A::pause)
}
extern "C" fn resume<A: Action>(leaf: *mut c_void) {
    call(leaf, (), A::resume)
}
extern "C" fn progress<A: Action>(leaf: *mut c_void) -> f64 {
    call(leaf, 0.0, A::progress)
}

/// An input of type double.
pub const fn double_input(name: *const c_char, default_value: *const c_char, doc: *const c_char) -> Port {
    let struct_size = std::mem::size_of::<Port>() as u32;
    Port { struct_size, kind: 3, direction: 1, name, default_value, unit: null(), doc }
}

impl LeafType {
    pub const fn of<A: Action>(id: *const c_char, doc: *const c_char, ports: &'static [&'static Port]) -> Self {
        LeafType {
            struct_size: std::mem::size_of::<LeafType>() as u32,
            kind: 1,
            id,
            doc,
            port_count: ports.len() as u32,
            ports: ports.as_ptr(),
            create: create::<A>,
            destroy: destroy::<A>,
            start: start::<A>,
            tick: tick::<A>,
            halt: halt::<A>,
            pause: pause::<A>,
            resume: resume::<A>,
            progress: progress::<A>,
            get_extension: null(),
        }
    }
}

impl Plugin {
    pub const fn of(name: *const c_char, doc: *const c_char, leaves: &'static [&'static LeafType]) -> Self {
        Plugin {
            abi_major: 1,
            abi_minor: 0,
            struct_size: std::mem::size_of::<Plugin>() as u32,
            name,
            version: null(),
            doc,
            leaf_type_count: leaves.len() as u32,
            leaf_types: leaves.as_ptr(),
            unused: [null(); 5],
        }
    }
}
