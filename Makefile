# Developers' tasks; scripts/demo.sh and scripts/test.sh do without make.
.DEFAULT_GOAL := help
.PHONY: help build test python wheel deb book book-commands slurm-check fuzz test-ipopt-3.14 random-tasks random-plans test-threads miri oracle bench bench-quick bench-parts bench-kkt casadi lint doc import-circles urdf-real demo fresh table2 figures reproduction platform-fit clean page

help: ## show this list
	@awk -F ':.*## ' '/^[a-z0-9.-]+:.*## / { printf "  %-16s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

build: ## build the library and the program in release
	cargo build --release --locked --workspace

test: ## run every test in release
	scripts/test.sh

python: ## test the Python package
	scripts/python.sh

book-commands: ## run every command of the book, one after another (minutes)
	cargo test --release --locked --test cli all_commands_of_the_book -- --ignored --nocapture

book: ## make the book of docs/ in target/book, links checked
	scripts/book.sh

deb: ## build the Debian package and try it in a new Debian 12 (root, debootstrap)
	scripts/deb.sh

wheel: ## build the Python wheel with Ipopt inside and try it in a new Debian 12 (root, debootstrap)
	scripts/wheel.sh

page: ## test report.html in Chromium (installs Debian's chromium, two packages of npm)
	scripts/page.sh

slurm-check: ## plan batches on a Slurm of one node, from Debian's packages, with tasks killed (root)
	scripts/slurm-check.sh

fuzz: ## read a million damaged files of each kind: no panic, none takes a second or 512 MiB
	FFSM_FUZZ_INPUTS=1000000 cargo test --release --locked --test fuzz -- --test-threads=1 --nocapture

test-ipopt-3.14: ## run the tests against a newer Ipopt, 3.14
	scripts/ipopt-3.14.sh

random-tasks: ## 300 random tasks by our linear solver and by MUMPS, their verdicts compared
	cargo test --release --locked --test linear_solver three_hundred -- --ignored --nocapture

random-plans: ## 200 random tasks as people bring them, planned to the tolerance, their verdicts counted
	cargo test --release --locked --test random_plans many_random -- --ignored --nocapture

test-threads: ## four threads solving for a minute, against one thread
	cargo test --release --locked --test ipopt for_a_minute -- --ignored

miri: ## look for undefined behaviour and races in the helper threads (needs a nightly Rust with miri)
	MIRIFLAGS=-Zmiri-ignore-leaks CARGO_TARGET_DIR=target/miri cargo +nightly miri test --locked --lib parallel

oracle: ## hold plans and golden values against Pinocchio, SPART and MuJoCo
	scripts/oracle.sh

bench: ## time the program against CasADi, yapss, maptor and mpopt, one table of ratios; scaling, roofline
	scripts/bench.sh
	cargo bench --locked --bench scaling
	cargo bench --locked --bench kkt

bench-quick: ## the same with fewer runs and without the slowest peer
	scripts/bench.sh --quick

bench-parts: ## time dynamics, derivatives and solves apart, with scaling exponents
	cargo bench --locked

bench-kkt: ## our linear solver beside MUMPS on recorded systems (needs libmumps-seq-dev)
	scripts/bench-kkt.sh

casadi: ## time one collocation point beside CasADi's generated code (compiles for many minutes)
	scripts/casadi.sh

lint: ## check the formatting and run clippy, warnings being errors
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --release --locked -- -D warnings

doc: ## build the API documentation
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --release --locked

import-circles: ## print the circles of files that import each other
	scripts/import-circles.sh

urdf-real: ## plan motions of real robots from their unedited URDF files
	scripts/urdf-real.sh

demo: ## plan the example trajectory
	scripts/demo.sh

fresh: ## run the demo, the tests and the reproduction in a new Debian 12 (root, debootstrap)
	scripts/fresh-debian.sh all

table2: ## compute the comparison of the methods (Table 2)
	cargo run --release --locked --bin ffsm-ipopt -- table2

figures: ## draw the figures of the paper from own runs
	cargo run --release --locked --bin ffsm-ipopt -- figures

reproduction: ## compute all of the paper again and write docs/reproduction.md
	scripts/reproduction.sh

platform-fit: ## which disturbances of the ground platform explain the paper's measurements
	cargo run --release --locked --bin ffsm-ipopt -- simulate --fit config/platforms/published.toml
	cargo run --release --locked --bin ffsm-ipopt -- simulate --fit config/platforms/published-heavy-base.toml

clean: ## remove what was built and computed
	cargo clean
	rm -rf out
