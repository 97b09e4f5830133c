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
         diagnostics_rendering reading regress engine cli outputs wording docs docs_elements version help package_files parts screws \
         builder_words builder_bodies builder_edits gallery sweep crossings notebooks elastic_core \
         stiffness_cases

# Tests that compare words with files.
WORDED := wording advice_wording broken_decks appearance builder_sections docs docs_sessions element_table gallery keywords

.PHONY: demo test test-all check core-test lint wording gallery vscode attack attack-steps fuzz crossing bench reference patterns paper wheel wheel-test sdist second-opinion docs clean

demo: .venv/ready-to-run
	$(BIN)/flexact analyse input_decks/paper/six_folded_sheets.dat -o results
	$(BIN)/flexact report input_decks/paper/six_folded_sheets.dat -o results/six_folded_sheets.html
	$(BIN)/flexact cost input_decks/paper/six_folded_sheets.dat --stroke 1:z=0.026..0.034 \
	  -o results/six_folded_sheets_cost.png
	@echo
	@echo "Written to the folder results:"
	@ls results

test: .venv/ready-to-test core-test
	$(PYTEST) --sample

# All cases of all tests, random decks and mechanisms, and a part of the crossing: an hour, for a nightly job.
test-all: .venv/ready-to-test core-test
	$(PYTEST)
	$(BIN)/python tests/attack/run_steps.py --count 100
	$(BIN)/python tests/attack/run.py --count 2000 --quiet
	$(BIN)/python tests/crossing/run.py --minutes 15

# Under a minute: lint of Python, the core, and the quick part of the tests.
check: .venv/ready-to-test core-test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(PYTEST) $(QUICK:%=tests/python/test_%.py)

# The core with run-time checks and sanitizers, also of threads, and its unit tests.
core-test: .venv/ready-to-test
	PATH="$(CURDIR)/$(BIN):$$PATH" tools/test_core.sh

lint: .venv/ready-to-test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/fprettify --diff --recursive fortran tests/fortran tests/fuzz tests/patterns tests/second_opinion | (! grep .)

# Write what results and messages say now where the tests compare it; read git diff afterwards.
wording: .venv/ready-to-test
	$(BIN)/python -m pytest --renew-wording $(WORDED:%=tests/python/test_%.py)
	git diff --stat -- tests/python/golden tests/python/decks input_decks/broken README.md docs

# Pages of the gallery, in results/gallery those that move, and pictures of other pages.
gallery: .venv/ready-to-test
	$(BIN)/python tools/gallery.py results/gallery
	$(BIN)/python tools/element_pictures.py
	$(BIN)/python tools/page_pictures.py

# The extension for VS Code, editors/vscode/flexact-*.vsix; needs Node.js.
vscode:
	cd editors/vscode && npm ci && npm run package

# Advice on 100 random mechanisms; then random decks with exact counts, until stopped with Ctrl-C;
# offending ones go to build/attack.
attack: .venv/ready-to-test
	$(BIN)/python tests/attack/run_steps.py --count 100
	$(BIN)/python tests/attack/run.py --keep build/attack

# Advice on 2,000 random mechanisms: steps, statements, hardware and causes; half an hour.
attack-steps: .venv/ready-to-test
	$(BIN)/python tests/attack/run_steps.py

# Ten minutes of real decks with random mistakes; offending ones go to build/fuzz.
fuzz: .venv/ready-to-test
	PATH="$(CURDIR)/$(BIN):$$PATH" tools/test_core.sh --build-only
	$(BIN)/python tests/fuzz/run.py --keep build/fuzz

# Some hours: every mechanism of the gallery and every sample deck, changed in many ways, through every verb and form
# of output. It goes on where it was stopped; CROSSING="--minutes 30 --only guide --again" and the like choose.
crossing: .venv/ready-to-test
	$(BIN)/python tests/crossing/run.py $(CROSSING)

# Some minutes; for development, run.py --quick.
bench: .venv/ready-to-test
	$(BIN)/python tests/benchmarks/run.py
	$(BIN)/python paper/make.py --numbers

# What a finite-element package that is not ours (CalculiX) finds; some minutes.
reference: .venv/ready-to-test
	$(BIN)/python tests/reference/finite_elements/run.py

# Ten million small random sparse matrices and ten thousand larger ones through the Cholesky factor; minutes.
patterns: .venv/ready-to-test
	PATH="$(CURDIR)/$(BIN):$$PATH" tests/patterns/run.sh
# The paper's figures and numbers, and results/paper.html where pandoc is installed.
paper: .venv/ready-to-run
	$(BIN)/python paper/make.py

# Wheels that hold all they need, in dist/; as root for the Pythons of two Debians. See docs/installing.md.
wheel: .venv/ready-to-run
	PYTHON="$(PYTHON)" tools/wheel.sh

# They at work in systems that have Python alone; needs root.
wheel-test:
	PYTHON="$(PYTHON)" tools/wheel_test.sh

# The sources as they are published, in dist/, built from there in an environment of its own.
sdist: .venv/ready-to-run
	PYTHON="$(PYTHON)" tools/sdist.sh

# The same analyses by our factor and by CHOLMOD's, which no count may tell apart; some minutes.
second-opinion: .venv/ready-to-test
	PATH="$(CURDIR)/$(BIN):$$PATH" tests/second_opinion/build.sh
	OPENBLAS_NUM_THREADS=1 build/patterns/tests/second_opinion/test_second_opinion 1000
	$(BIN)/python tests/second_opinion/run.py

# The site, results/site/index.html: read from disk, without a network. Its links are checked.
docs: .venv/ready-to-docs
	$(BIN)/python tools/site/live.py results/live
	@# The generator's older major version is asked for: a notice of the newer one is not wanted.
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet -f tools/site/mkdocs.yml
	$(BIN)/python tools/site/check.py results/site

clean:
	rm -rf .venv build results dist

.venv/ready-to-run .venv/ready-to-test .venv/ready-to-docs: $(SOURCES)
	PYTHON="$(PYTHON)" tools/setup.sh $(@:.venv/ready-to-%=%)
