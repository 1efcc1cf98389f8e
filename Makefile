# Needs Python 3.11 or newer, git and make; everything else goes into .venv.
# Another interpreter: make PYTHON=python3.12 demo. Another place for the demo's results: make DEMO=out/mine demo.

VENV := .venv
BIN := $(VENV)/bin
DEMO := out/demo
DOCS := docs/_build/html
# Every script that draws for the manual; those that are left out draw what is kept, on demand.
PLOTS := $(filter-out docs/plots/demo.py docs/plots/mechanism.py docs/plots/moving.py docs/plots/tour.py,$(wildcard docs/plots/*.py))
DRAWN := $(PLOTS:docs/plots/%.py=docs/_build/drawn/%)
PROGRAM := $(shell find src packages -name '*.py' -o -name '*.toml' -o -name '*.js' -o -name '*.css')
# One more than there are cores: many tests wait for processes that they watch.
# With bytecode kept, which containers often switch off: hundreds of processes import the package. Matrices are
# small: a second thread for each of them takes time from another test.
PYTEST := PYTHONDONTWRITEBYTECODE= OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n 3 --dist worksteal
# What `make test` leaves out of these, `make check` runs each day, and the seventh not again.
CHECKED := tests/unit/validation tests/unit/docs tests/faults/processes/test_elsewhere.py tests/browser/test_manual.py
NUMERICAL := $(addprefix tests/,analytic faults golden literature order)

.DELETE_ON_ERROR:
.PHONY: help demo assumptions ready kernels test check paper wheels check-long test-long golden lint format pages docs bench lock clean

help:
	@echo "make assumptions the demo, and what assumed numbers do to it, in its report"
	@echo "make demo        run the built-in vane mechanism; results in $(DEMO)"
	@echo "make kernels     compile the kernels, if they were edited"
	@echo "make test        the whole suite but its longest tests"
	@echo "make check       what takes longer: types, the paper in full, manual, validation, other systems, the wheels with the README's commands"
	@echo "make paper       figures and claims of the source paper, and the validation sets; results in out"
	@echo "make wheels      build and try the wheels, with dependencies at both ends of the declared versions"
	@echo "make check-long  the seventh of the longest tests that is today's"
	@echo "make test-long   those too, and numerical tests at ten neighbouring tolerances"
	@echo "make golden      store key results and messages anew"
	@echo "make lint        style, types, layers and spelling"
	@echo "make format      apply the style"
	@echo "make pages       write tables and measured numbers into the pages of the manual"
	@echo "make docs        build the manual into $(DOCS)"
	@echo "make bench       speed against other programs (some eighty minutes)"
	@echo "make lock        pin all dependencies anew, with hashes (needs uv)"
	@echo "make clean       remove .venv and everything built"

demo: kernels
	$(BIN)/tribodyn run vsv -o $(DEMO)

assumptions: demo
	$(BIN)/tribodyn sweep $(DEMO)/case.toml --vary joint.friction_coefficient=0.05,0.1,0.2 \
		--vary "contact.minimum_entry_velocity=0.1 mm/s,1 mm/s,5 mm/s" \
		--vary contact.onset_separation=3.5,4,4.5 --summary-only -o $(DEMO)/assumptions
	$(BIN)/tribodyn report $(DEMO)

test: ready
	$(PYTEST) -m "not long"

# A week of days runs all tests marked long: a seventh each day.
SEVENTH := $(shell expr $$(date +%s) / 86400 % 7)
# What is promised and takes longer than tests may: two at a time, the longest first.
check: ready $(VENV)/.docs
	$(MAKE) --jobs 2 --output-sync=target wheels docs paper lint
	$(PYTEST) --dist loadfile -m long $(CHECKED)

# The manual shows the validation sets, too: they are computed once.
paper: ready docs/_build/drawn/validation
	$(BIN)/tribodyn reproduce -o out/reproduction --quiet
	cp -R docs/_static/generated/validation out

wheels: ready
	tools/try-wheel $(BIN)/python out/wheels
	tools/try-bounds out/wheels

# One by one, the longest first: nobody waits for a long one at the end.
check-long: ready
	$(PYTEST) --dist load --maxschedchunk 1 -m long --part $(SEVENTH)/7 $(addprefix --ignore=,$(CHECKED))

# Numerical tests must not depend on rounding: ten relative tolerances 1e-9 apart take other roundings each.
test-long: ready
	$(PYTEST)
	for factor in 1 2 3 4 5 6 7 8 9; do \
		$(PYTEST) -m "not long and not architecture" --tolerance-factor=$$factor $(NUMERICAL) || exit 1; \
	done

golden: $(VENV)/.dev
	$(BIN)/python tests/golden/test_key_results.py
	$(BIN)/python tests/golden/test_messages.py
	$(BIN)/python tests/golden/test_signatures.py

lint: $(VENV)/.dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/codespell

format: $(VENV)/.dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

NUMBERS := docs/_static/generated/numbers.json
pages: $(VENV)/.docs $(addprefix docs/_build/drawn/,measured validation bem mechanism_gallery)
	$(BIN)/python docs/fill.py --numbers $(NUMBERS) --made docs/_static/generated

docs: $(VENV)/.docs docs/_build/drawn/validation
	$(MAKE) --jobs 2 $(DRAWN) docs/_build/unread
	$(BIN)/python docs/fill.py --check --numbers $(NUMBERS) --made docs/_static/generated
	$(BIN)/sphinx-build -W --keep-going -j 2 -b html docs $(DOCS)
	@echo "Open $(DOCS)/index.html"

# What the program draws and prints for the manual is made anew where the program has changed.
docs/_build/drawn/%: docs/plots/%.py $(PROGRAM) | $(VENV)/.run
	$(BIN)/python $< docs/_static/generated
	@mkdir -p $(@D) && touch $@

docs/_build/drawn/measured: $(wildcard docs/plots/measures/*.py) docs/_static/benchmarks.json

docs/_build/unread: $(PROGRAM)
	rm -rf $(DOCS)/.doctrees docs/reference/generated
	@mkdir -p $(@D) && touch $@

bench: $(VENV)/.bench
	$(BIN)/python -m benchmarks.solver.work_precision
	$(BIN)/python -m benchmarks

lock:
	uv pip compile --upgrade --generate-hashes --universal --no-header --python-version 3.11 --all-extras --no-emit-package mebdf pyproject.toml -o requirements.lock
	uv pip compile --generate-hashes --universal --no-header --python-version 3.11 -c requirements.lock --no-emit-package mebdf pyproject.toml -o tools/container.lock

clean:
	rm -rf $(VENV) docs/_build docs/reference/generated docs/validation/sets docs/_static/generated .mypy_cache .ruff_cache .pytest_cache .import_linter_cache

# Stamps: an environment is made once, and again when pyproject.toml changes.

$(BIN)/python:
	@tools/make-venv $(VENV)

# Installed as they are, without what a wheel is built with.
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check
EDITABLE := $(PIP) --no-build-isolation --editable packages/mebdf --editable

$(VENV)/.run: pyproject.toml $(BIN)/python
	$(PIP) "hatchling>=1.24" "hatch-fancy-pypi-readme>=24.1" editables
	$(EDITABLE) ".[compile]"
	@touch $@

$(VENV)/.dev: $(VENV)/.run
	$(EDITABLE) ".[compile,sundials,surfaces,dev,docs]"
	@touch $@

# What tests need. Kernels are compiled on one core while pip, on the other, installs what only tests need.
ready: $(VENV)/.run
	@$(MAKE) --no-print-directory -j 2 kernels $(VENV)/.dev
	@tools/ensure-browser

kernels: $(VENV)/.run
	@$(BIN)/python -m mebdf.compiled.make mebdf tribodyn

$(VENV)/.bench: $(VENV)/.run
	$(EDITABLE) ".[compile,sundials,surfaces,dev,bench]"
	@touch $@ $(VENV)/.dev

$(VENV)/.docs: $(VENV)/.run
	$(EDITABLE) ".[compile,sundials,surfaces,docs]"
	@touch $@
