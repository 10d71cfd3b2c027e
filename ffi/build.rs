//! Finds the system Ipopt and writes bindings to its C interface.

use std::env;
use std::path::PathBuf;
use std::process::exit;

const PACKAGES: &str = "apt-get install coinor-libipopt-dev libclang-dev pkg-config";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=wrapper.h");
    println!("cargo::rerun-if-env-changed=LIBCLANG_PATH");
    println!("cargo::rustc-check-cfg=cfg(ipopt_hsl_loader, ipopt_bridge)");

    let ipopt = find();
    // `pkg-config --libs` also names libraries whose -dev packages need not be there (LAPACK,
    // MUMPS); libipopt.so brings what it needs by itself.
    for path in &ipopt.link_paths {
        println!("cargo::rustc-link-search=native={}", path.display());
    }
    println!("cargo::rustc-link-lib=dylib=ipopt");
    println!("cargo::metadata=VERSION={}", ipopt.version);
    println!("cargo::rustc-env=IPOPT_SYS_VERSION={}", ipopt.version);

    let has = |header: &str| {
        ipopt
            .include_paths
            .iter()
            .any(|path| path.join(header).exists())
    };
    let on_linux = env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux");
    if has("HSLLoader.h") {
        println!("cargo::rustc-cfg=ipopt_hsl_loader");
        if on_linux {
            println!("cargo::rerun-if-changed=src/usage.c");
            cc::Build::new().file("src/usage.c").compile("usage");
        }
    } else if on_linux {
        build_bridge();
        println!("cargo::rustc-cfg=ipopt_bridge");
    }
    bind(&ipopt);
}

/// The Ipopt that pkg-config knows. Rebuilds follow `PKG_CONFIG_PATH` and its like.
fn find() -> pkg_config::Library {
    let found = pkg_config::Config::new()
        .cargo_metadata(false)
        .env_metadata(true)
        .atleast_version("3.11")
        .probe("ipopt");
    let why = match found {
        Ok(ipopt) => return ipopt,
        Err(pkg_config::Error::Command { command, cause }) => {
            format!("pkg-config could not be run ({cause}; command: {command})")
        }
        Err(pkg_config::Error::EnvNoPkgConfig(variable)) => {
            format!("the environment variable {variable} forbids pkg-config for Ipopt")
        }
        Err(error) => {
            format!(
                "pkg-config finds no Ipopt, version 3.11 or later: {}",
                first_line(&error)
            )
        }
    };
    fail(&format!(
        "{why}. Install Ipopt ({PACKAGES}), or set PKG_CONFIG_PATH to the directory of its ipopt.pc"
    ))
}

/// Makes the shared library that hands the calls of HSL_MA97's interface back to us.
fn build_bridge() {
    let source = "src/bridge.c";
    println!("cargo::rerun-if-changed={source}");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR")).join("bridge.so");
    let mut compiler = cc::Build::new().pic(true).get_compiler().to_command();
    compiler.args(["-shared", "-o"]).arg(&out).arg(source);
    match compiler.status() {
        Ok(status) if status.success() => {}
        outcome => fail(&format!(
            "the C compiler cannot make a shared library of {source} ({outcome:?}). Install one \
             (apt-get install gcc libc6-dev), or set CC"
        )),
    }
}

fn bind(ipopt: &pkg_config::Library) {
    // Without libclang bindgen panics; one sentence that names the package helps more.
    std::panic::set_hook(Box::new(|_| {}));
    let clang = std::panic::catch_unwind(bindgen::clang_version);
    drop(std::panic::take_hook());
    if clang.is_err() {
        fail(&format!(
            "bindgen finds no libclang, which it reads Ipopt's C headers with. Install it \
             ({PACKAGES}), or set LIBCLANG_PATH to the directory of libclang.so"
        ));
    }
    let includes = ipopt
        .include_paths
        .iter()
        .map(|path| format!("-I{}", path.display()));
    let defines = ipopt.defines.iter().map(|(name, value)| match value {
        Some(value) => format!("-D{name}={value}"),
        None => format!("-D{name}"),
    });
    let bindings = bindgen::Builder::default()
        .header("wrapper.h")
        .clang_args(includes.chain(defines))
        .allowlist_function("(Create|Free)IpoptProblem")
        .allowlist_function("AddIpopt(Str|Num|Int)Option")
        .allowlist_function("OpenIpoptOutputFile|SetIntermediateCallback|IpoptSolve")
        .allowlist_function(
            "LSL_(loadHSL|isHSLLoaded|isMA(27|57|77|86|97)available|isMC19available|setMA97)",
        )
        .allowlist_type("Bool|Index|Number|Int|UserDataPtr|IpoptProblem|Eval_.*_CB")
        .allowlist_type("Intermediate_CB|ApplicationReturnStatus|AlgorithmMode")
        .prepend_enum_name(false)
        .layout_tests(false)
        .rust_edition(bindgen::RustEdition::Edition2024)
        .parse_callbacks(Box::new(bindgen::CargoCallbacks::new()))
        .generate();
    let bindings = match bindings {
        Ok(bindings) => bindings,
        Err(error) => fail(&format!(
            "bindgen cannot read the headers of Ipopt {} ({error}). Reinstall them: {PACKAGES}",
            ipopt.version
        )),
    };
    let out =
        PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR")).join("bindings.rs");
    if let Err(error) = bindings.write_to_file(&out) {
        fail(&format!("cannot write {}: {error}", out.display()));
    }
}

fn first_line(error: &pkg_config::Error) -> String {
    error
        .to_string()
        .lines()
        .find(|line| !line.trim().is_empty())
        .unwrap_or_default()
        .to_owned()
}

fn fail(message: &str) -> ! {
    println!("cargo::error={message}");
    exit(1)
}
