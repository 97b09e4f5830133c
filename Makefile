# make demo and make test work from a clean clone; PYTHON=... chooses the Python.
PYTHON ?= python3
SOURCES := meson.build meson.options pyproject.toml tools/setup.sh \
           $(shell find fortran python -name '*.f90' -o -name '*.py' -o -name '*.js' -o -name '*.css' \
             -o -name '*.html' -o -name meson.build)
BIN := .venv/bin

# One worker a processor, each with one thread; a worker without work takes from the others.
PYTEST := OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n auto --dist worksteal

# What make check asks of the package: see CONTRIBUTING.md.
QUICK := element_table paper invariance analysis analysis_result methods margin model model_errors boundary \
         derivatives certainty accuracy json advice advice_on_declarations modes broken_decks no_cascades \
         diagnostics_rendering reading regress engine cli outputs wording docs version package_files parts screws \
         builder_words builder_bodies builder_edits gallery sweep crossings notebooks elastic_core \
         stiffness_cases

# Tests that compare words with files.
WORDED := wording advice_wording broken_decks appearance docs element_table gallery keywords

.PHONY: demo test check core-test lint wording gallery vscode attack fuzz bench reference clean

demo: .venv/ready-to-run
	$(BIN)/flexact analyse input_decks/paper/six_folded_sheets.dat -o results
	$(BIN)/flexact report input_decks/paper/six_folded_sheets.dat -o results/six_folded_sheets.html
	$(BIN)/flexact cost input_decks/paper/six_folded_sheets.dat --stroke 1:z=0.026..0.034 \
	  -o results/six_folded_sheets_cost.png
	@echo
	@echo "Written to the folder results:"
	@ls results

test: .venv/ready-to-test core-test
	$(PYTEST)

# Under a minute: lint of Python, the core, and the quick part of the tests.
check: .venv/ready-to-test core-test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(PYTEST) $(QUICK:%=tests/python/test_%.py)

# The core with run-time checks and sanitizers, and its unit tests.
core-test: .venv/ready-to-test
	PATH="$(CURDIR)/$(BIN):$$PATH" tools/test_core.sh

lint: .venv/ready-to-test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/fprettify --diff --recursive fortran tests/fortran tests/fuzz | (! grep .)

# Write what results and messages say now where the tests compare it; read git diff afterwards.
wording: .venv/ready-to-test
	$(BIN)/python -m pytest --renew-wording $(WORDED:%=tests/python/test_%.py)
	git diff --stat -- tests/python/golden tests/python/decks input_decks/broken README.md docs

# Pages of the gallery, and in results/gallery those that move.
gallery: .venv/ready-to-run
	$(BIN)/python tools/gallery.py results/gallery

# The extension for VS Code, editors/vscode/flexact-*.vsix; needs Node.js.
vscode:
	cd editors/vscode && npm ci && npm run package

# Random decks with exact counts, until stopped with Ctrl-C; offending ones go to build/attack.
attack: .venv/ready-to-test
	$(BIN)/python tests/attack/run.py --keep build/attack

# Ten minutes of real decks with random mistakes; offending ones go to build/fuzz.
fuzz: .venv/ready-to-test
	PATH="$(CURDIR)/$(BIN):$$PATH" tools/test_core.sh --build-only
	$(BIN)/python tests/fuzz/run.py --keep build/fuzz

# Some minutes; for development, run.py --quick.
bench: .venv/ready-to-test
	$(BIN)/python tests/benchmarks/run.py

# What a finite-element package that is not ours (CalculiX) finds; some minutes.
reference: .venv/ready-to-test
	$(BIN)/python tests/reference/finite_elements/run.py

clean:
	rm -rf .venv build results

.venv/ready-to-run .venv/ready-to-test: $(SOURCES)
	PYTHON="$(PYTHON)" tools/setup.sh $(@:.venv/ready-to-%=%)
