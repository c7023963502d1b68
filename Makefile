# Everything is set up inside the clone: a virtual environment in .venv, pictures and tables in out.
PYTHON ?= python3.11
BIN := .venv/bin

# pip tells only what went wrong, also where maturin calls it.
export PIP_QUIET := 1
export PIP_DISABLE_PIP_VERSION_CHECK := 1

.PHONY: demo test campaign setup extras deny mutants bench bench-core tables table2 ompl clean

demo: setup
	$(BIN)/elbowroom paper --out out/paper
	@echo "Open out/paper/report.md, or the pictures in out/paper/paper-standin."

test: setup extras
	cargo fmt --check
	cargo clippy --workspace --all-targets -- -D warnings
	cargo clippy -p elbowroom --lib --no-default-features -- -D warnings
	cargo test --workspace --quiet
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --quiet
	@if command -v cargo-deny >/dev/null; then $(DENY); else echo "SKIPPED: cargo-deny is not installed; make deny installs it"; fi
	$(BIN)/ruff format --check python tests bench fuzz
	$(BIN)/ruff check python tests bench fuzz
	$(BIN)/mypy
	MYPYPATH=python $(BIN)/python -m mypy.stubtest elbowroom._core
	$(BIN)/python -m pytest -n auto

# The tables of docs/ that our own planners make.
tables: setup
	$(BIN)/python -m bench.objectives
	$(BIN)/python -m bench.bounds
	$(BIN)/python -m bench.moving
	$(BIN)/python -m bench.motions

# All planners on the same tasks (docs/table2.md); rows that are there in out/table2 are kept. An hour on two cores.
table2: setup
	$(BIN)/python -m bench.table2

# Safety at length: 100,000 random worlds, a million edges and pieces, 10,000 worlds by brute force and by their fastest motions, and
# 10,000 episodes among moving discs; two hours on two cores.
campaign:
	cargo test --release -p elbowroom --test campaign -- --ignored --nocapture --test-threads 1
	cargo test --release -p elbowroom --test bound -- --ignored --nocapture
	cargo test --release -p elbowroom --test replanner -- --ignored --nocapture

# elbowroom beside its peers, in an environment of its own: docs/benchmarks.md and its pictures, about half an hour; and how near the
# least time along their paths motions are (docs/motions.md), which CasADi judges.
# A peer that does not install is a row that says so. OMPL in C++ takes part where libompl-dev and cmake are installed.
bench:
	@test -x .venv-bench/bin/python || $(PYTHON) -m venv .venv-bench
	@.venv-bench/bin/python -m pip install --upgrade "pip>=25.1"
	@.venv-bench/bin/python -m pip install .
	@for peer in $$(.venv-bench/bin/python -m bench.group bench); do \
		.venv-bench/bin/python -m pip install "$$peer" || echo "$$peer does not install"; \
	done
	cargo build --release --quiet -p elbowroom --example measure
	.venv-bench/bin/python -m bench
	.venv-bench/bin/python -m bench.along_path

# Criterion's benchmarks of the core alone.
bench-core:
	cargo bench --workspace

# Compares with OMPL (docs/ompl.md) in an environment of its own; rewrites the tables of that page and its picture.
ompl:
	@test -x .venv-ompl/bin/python || $(PYTHON) -m venv .venv-ompl
	@.venv-ompl/bin/python -m pip install --upgrade "pip>=25.1"
	@.venv-ompl/bin/python -m pip install . ompl==2.0.1
	.venv-ompl/bin/python bench/ompl_safety.py --worlds 100 --seed 0 --out docs/ompl.md
	.venv-ompl/bin/python bench/ompl_picture.py --out docs/images/ompl_contact.png

# Licences, duplicates and sources of what is depended on; advisories have a database of their own, which hosted CI fetches.
DENY := cargo deny --log-level error check licenses bans sources
deny:
	@command -v cargo-deny >/dev/null || cargo install --locked cargo-deny
	$(DENY)

# 150 mutants, each against the tests of its module: docs/mutants.md, within an hour on two cores.
mutants: setup
	@command -v cargo-mutants >/dev/null || cargo install --locked cargo-mutants
	$(BIN)/python -m bench.mutants

# Builds the extension when its sources changed; a complaint about a missing tool is one line.
setup: .venv/installed
	@$(BIN)/maturin develop --release --quiet --skip-install

PIP := $(BIN)/python -m pip install

# Asks the network only where the list of what is needed changed, or the clone is new.
.venv/installed: pyproject.toml Makefile
	@command -v cargo >/dev/null 2>&1 || { echo "error: no Rust toolchain found; install Rust 1.89 or newer from https://rustup.rs" >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { echo "error: $(PYTHON) is not Python 3.11 or newer; install it, or name another: make PYTHON=python3.12 $(MAKECMDGOALS)" >&2; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv .venv
	@$(PIP) --upgrade "pip>=25.1"
	@$(PIP) --group dev
	@$(BIN)/maturin develop --release --quiet
	@touch $@

# Tried again each time while one of them does not install.
extras: .venv/installed
	@test .venv/extras -nt .venv/installed || { \
		missing=0; \
		for extra in $$($(BIN)/python -m bench.group extras); do \
			$(PIP) "$$extra" || { missing=1; echo "SKIPPED: $$extra does not install, its tests are left out"; }; \
		done; \
		test $$missing = 1 || touch .venv/extras; \
	}

clean:
	rm -rf .venv .venv-ompl .venv-bench out target
