# make run    builds everything and runs the first example
# make test   every check there is
# make help   the rest

.DELETE_ON_ERROR:
MAKEFLAGS += --no-builtin-rules

# How long `make fuzz` runs each target, s.
SECONDS ?= 60

# Python to make the environment with (default: the first of python3, python3.14 … of 3.10 or
# later), the environment, extra flags for cargo (`LOCKED=--locked`: Cargo.lock must fit).
PYTHON ?=
VENV   ?= .venv
LOCKED ?=

PY        := $(VENV)/bin/python
RUN_STAMP := $(VENV)/.run-stamp
DEV_STAMP := $(VENV)/.dev-stamp
EXTENSION := $(VENV)/.extension-stamp
SOURCES   := $(shell find rust/core rust/py Cargo.toml $(wildcard Cargo.lock) pyproject.toml -not -name '.*')

# How `make test` and `make check` run steps side by side: each line's output comes whole, when it
# has ended. Everything else runs one step after another.
CORES        := $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
SIDE_BY_SIDE := --no-print-directory -j$(CORES) TRACKS=1 \
  $(if $(filter output-sync,$(.FEATURES)),--output-sync=line)
ifndef TRACKS
.NOTPARALLEL:
endif

# One Python for every cargo command, so that nothing is compiled twice; the same random cases
# in every run of the Rust tests (`PROPTEST_RNG_SEED=… PROPTEST_CASES=…` for others).
export PYO3_PYTHON := $(abspath $(PY))
export PROPTEST_RNG_SEED ?= 1
export MPLBACKEND ?= Agg

# On every core, each file on one: what its tests share is made once.
PYTEST := $(PY) -m pytest -q -n auto --dist loadfile

.PHONY: help run check test rust-test rust-lint python-test python-lint lint types quick-tests pytest docs gallery \
  wheel bench campaign fuzz clean rust-tools lint-tools
.DEFAULT_GOAL := help

help:
	@echo "make run          build, then run examples/first_run.py"
	@echo "make check        the daily loop: format, lints, types and the quick tests"
	@echo "make test         format, lints, types, unit, integration and documentation tests"
	@echo "make rust-test    the Rust half of it"
	@echo "make python-test  the Python half of it"
	@echo "make docs         these pages, the API and the gallery: docs/_build/html/index.html"
	@echo "make gallery      the gallery's pages and pictures alone: docs/gallery"
	@echo "make wheel        a wheel for release in dist/, audited, installed and tested"
	@echo "make bench        benchmarks, beside NumPy and numba; docs/explanation/speed.md"
	@echo "make campaign     random mechanisms by the hundred thousand (three hours); docs/developers/campaigns"
	@echo "make fuzz         libFuzzer on the core, SECONDS=60 each target (fuzz/README.md)"
	@echo "make clean        remove everything that was built, the environment too"

run: rust-tools $(EXTENSION)
	@$(PY) examples/first_run.py

# What fails most often, in half a minute once everything is built.
check: lint-tools $(EXTENSION) $(DEV_STAMP)
	@$(MAKE) $(SIDE_BY_SIDE) types quick-tests rust-lint lint

rust-lint: lint-tools
	cargo fmt --all --check
	$(PY) tools/check_order
	cargo clippy $(LOCKED) --workspace -- -D warnings

lint: $(EXTENSION) $(DEV_STAMP)
	$(PY) -m ruff check
	$(PY) -m ruff format --check
	$(PY) tools/check_floors
	$(PY) tools/check_sizes
	$(VENV)/bin/lint-imports --no-logo --no-cache
	$(VENV)/bin/zizmor --offline --quiet .github
	$(PY) tools/error_page --check
	$(PY) tools/examples_page --check
	$(PY) tools/front_picture --check

types: $(EXTENSION) $(DEV_STAMP)
	$(PY) -m mypy

# Results at one level of vector instructions; `make test` compares them at all.
quick-tests: $(EXTENSION) $(DEV_STAMP)
	$(PYTEST) -k "not (avx2 or avx512)" tests/python/net/test_digests.py \
	  tests/python/description tests/python/papers tests/python/package/test_pages.py \
	  tests/python/package/test_examples_in_docstrings.py

# On one core for minutes each, where they end, the release build of the extension and the builds of
# the Rust tests share the machine. The Python tests have it to themselves: some measure time.
test: lint-tools $(RUN_STAMP)
	@$(MAKE) $(SIDE_BY_SIDE) rust-test python-lint
	@$(MAKE) --no-print-directory pytest
	@echo "All checks passed."

# With both packages, so that cargo takes the very library that the extension was built from: alone,
# the core would have dependencies with fewer features.
CARGO_TEST_RELEASE := cargo test $(LOCKED) --release -p assur -p assur-py --features test-hooks
# Unit tests run little of the solver and compile ten times as quickly without optimisation (which
# wants deep stacks). The others use the extension's library, without checks of overflow. `cargo test` by
# itself does the same tests, all with some optimisation and all checks.
rust-test: lint-tools $(RUN_STAMP)
	cargo fmt --all --check
	$(PY) tools/check_order
	cargo clippy $(LOCKED) --workspace --all-targets -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc $(LOCKED) --workspace --no-deps
	CARGO_PROFILE_DEV_OPT_LEVEL=0 RUST_MIN_STACK=67108864 cargo test $(LOCKED) --lib
	$(CARGO_TEST_RELEASE) --test '*'
	MAKEFLAGS= $(CARGO_TEST_RELEASE) --doc # or rustdoc looks for a jobserver that make does not share

python-test: python-lint pytest

python-lint: lint types
	$(PY) -m mypy.stubtest --mypy-config-file pyproject.toml assur._core

pytest: rust-tools $(EXTENSION) $(DEV_STAMP)
	$(PYTEST)

# Warnings are errors: of broken links and of names without a page, too.
docs: gallery
	@$(PY) -m pip install --quiet --group docs
	@rm -rf docs/_build docs/reference/api/generated
	$(PY) -m sphinx -b html -n -W --keep-going -q -j auto docs docs/_build/html
	@echo "docs/_build/html/index.html"

gallery: rust-tools $(EXTENSION)
	$(PY) tools/gallery

# As released: without test-hooks, audited, installed away from the checkout and tested there.
wheel: rust-tools $(RUN_STAMP)
	@$(PY) -m pip install --quiet --group wheel
	rm -f dist/assur-*.whl
	$(PY) -m maturin build --release --out dist $(LOCKED)
	$(PY) tools/check_wheel dist -n auto --dist loadfile

bench: rust-tools $(EXTENSION)
	@$(PY) -m pip install --quiet --group bench
	cargo bench $(LOCKED) --features test-hooks
	$(PY) benches/python/run.py --write

CAMPAIGN := PYTHONPATH=tests/python $(PY) -m campaigns.campaign
campaign: rust-tools $(EXTENSION) $(DEV_STAMP)
	$(CAMPAIGN) --count 100000 --out docs/developers/campaigns/class_ii.md
	$(CAMPAIGN) --higher --count 10000 --out docs/developers/campaigns/higher.md
	$(CAMPAIGN) --mixed --count 100000 --out docs/developers/campaigns/mixed.md
	$(CAMPAIGN) --machines --count 10000 --out docs/developers/campaigns/machines.md
	PYTHONPATH=tests/python $(PY) -W ignore -m campaigns.campaign_assemblies
	PYTHONPATH=tests/python $(PY) -m campaigns.campaign_steps
	HYPOTHESIS_PROFILE=slow $(PY) -m pytest -q tests/python/net/test_function_of_q.py \
	  tests/python/net/test_careful.py tests/python/dynamics/friction/test_friction_random.py \
	  tests/python/dynamics/forces/test_reactions_oracle.py \
	  tests/python/dynamics/equations/test_derivatives.py \
	  tests/python/kinematics/test_agreement.py tests/python/kinematics/test_invariance.py \
	  tests/python/kinematics/test_angles_across_gaps.py tests/python/net/test_partial_requests.py \
	  tests/python/description/test_random_remedies.py tests/python/studio/test_edits.py \
	  tests/python/studio/browser/test_studio_in_browser.py

# Flags: the targets have no magic numbers to compare with, and one unit takes minutes to compile.
FUZZ := cargo fuzz run --sanitizer none --no-trace-compares --codegen-units 16
fuzz: rust-tools
	@for target in description structure solve; do \
	  mkdir -p fuzz/found/$$target && \
	  $(FUZZ) $$target fuzz/found/$$target fuzz/corpus/$$target -- \
	    -max_total_time=$(SECONDS) -timeout=60 -max_len=600 || exit 1; \
	done

clean:
	cargo clean
	rm -rf $(VENV) out dist docs/_build docs/reference/api/generated docs/gallery .hypothesis .mypy_cache .pytest_cache .ruff_cache
	rm -f python/assur/_core*.so
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# The extension module, built in place (python/assur) and made importable in the environment.
$(EXTENSION): $(SOURCES) $(RUN_STAMP)
	VIRTUAL_ENV=$(abspath $(VENV)) PIP_QUIET=1 $(PY) -m maturin develop --release --features test-hooks \
	  --group run $(LOCKED)
	@touch $@

ifdef TRACKS
$(EXTENSION): | $(DEV_STAMP) # one pip at a time
endif

$(DEV_STAMP): pyproject.toml $(RUN_STAMP)
	$(PY) -m pip install --quiet --group dev
	@touch $@

$(RUN_STAMP): pyproject.toml $(VENV)/pyvenv.cfg
	$(PY) -m pip install --quiet --group run
	@touch $@

$(VENV)/pyvenv.cfg:
	@python=$$(tools/find_python $(PYTHON)) || exit 1; \
	echo "Making $(VENV) with $$python"; \
	"$$python" -m venv --clear $(VENV) || { rm -rf $(VENV); \
	  echo "error: $$python cannot make a virtual environment: install its venv and ensurepip" \
	    "modules (Debian, Ubuntu: apt install python3-venv)" >&2; exit 1; }
	$(PY) -m pip install --quiet --upgrade "pip>=25.1"

rust-tools:
	@tools/check_rust

lint-tools: rust-tools
	@tools/check_rust fmt clippy
