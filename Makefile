# make demo and make test work from a clean clone; PYTHON=... chooses the Python.
PYTHON ?= python3
SOURCES := meson.build meson.options pyproject.toml tools/setup.sh \
           $(shell find fortran python -name '*.f90' -o -name '*.py' -o -name '*.js' -o -name '*.css' \
             -o -name '*.html' -o -name meson.build)
BIN := .venv/bin

.PHONY: demo test core-test lint bench clean

demo: .venv/ready-to-run
	$(BIN)/flexact analyse input_decks/paper/six_folded_sheets.dat -o results
	$(BIN)/flexact report input_decks/paper/six_folded_sheets.dat -o results/six_folded_sheets.html
	@echo
	@echo "Written to the folder results:"
	@ls results

test: .venv/ready-to-test core-test
	$(BIN)/python -m pytest

# The core with run-time checks, and its unit tests.
core-test: .venv/ready-to-test
	PATH="$(CURDIR)/$(BIN):$$PATH" tools/test_core.sh

lint: .venv/ready-to-test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/fprettify --diff --recursive fortran tests/fortran | (! grep .)

# Some minutes; for development, run.py --quick.
bench: .venv/ready-to-test
	$(BIN)/python tests/benchmarks/run.py

clean:
	rm -rf .venv build results

.venv/ready-to-run .venv/ready-to-test: $(SOURCES)
	PYTHON="$(PYTHON)" tools/setup.sh $(@:.venv/ready-to-%=%)
