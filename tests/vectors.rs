//! What the compiler has made of the code for the processor's vectors.
#![cfg(all(target_os = "linux", target_arch = "x86_64", not(debug_assertions)))]

use object::{Object, ObjectSymbol};

/// An intrinsic stands for one instruction. Where the function around it is not compiled for the
/// processor's vectors, as a closure that is not inlined, it becomes a function that is called.
#[test]
fn no_vector_instruction_is_a_function_call() {
    let program = std::fs::read(env!("CARGO_BIN_EXE_ffsm-ipopt")).expect("the program");
    let program = object::File::parse(&*program).expect("an executable");
    let names = || program.symbols().filter_map(|symbol| symbol.name().ok());
    assert!(
        names().any(|name| name.contains("ffsm_ipopt")),
        "stripped of its symbols, the program tells nothing"
    );
    let calls: Vec<&str> = names()
        .filter(|name| name.contains("core_arch") && name.contains("_mm"))
        .collect();
    assert!(calls.is_empty(), "{calls:#?}");
}
