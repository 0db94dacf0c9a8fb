# make run     set up and start the companion
# make test    set up and run the tests
# make slow    run the tests that take long by nature
# make fuzz    run the property tests with examples of chance; OPTIONS=--hypothesis-seed=1 repeats a run
# make check   format, lint, types, import rules, spelling, prose
# make bench   measure what is in benchmarks/ on this machine; OPTIONS="vision --only nods" one part
# make wheels  renew the locked packages in .ci/requirements/, with wheels for every supported Python and system
# make docs    the reference of all classes, in build/reference/
# make checklist    run the tests and write docs/checklist.md

PYTHON ?= python3
SHELL := bash
.SHELLFLAGS := -o pipefail -c
VENV   := .venv
BIN    := $(VENV)/bin

# What was compiled is kept: without that each of the many processes of the tests compiles everything again.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: run test slow fuzz check bench wheels docs checklist format clean

# The networks that see faces, once; without them they are found coarsely, and fewer nods.
FETCH_FACES := $(BIN)/hri models fetch face >/dev/null || echo "going on without seeing well"

# What follows from pip names each package and its size, with its progress.
TELL_SOURCE := echo "fetching packages from $$($(BIN)/python -m pip config get global.index-url \
  2>/dev/null || echo https://pypi.org/simple); each is named with its size ..."

run: $(VENV)/.run
	@$(FETCH_FACES)
	$(BIN)/hri companion $(OPTIONS)

test: $(VENV)/.dev
	@$(FETCH_FACES)
	$(BIN)/python -m pytest -n logical --dist loadfile -m "not slow" $(OPTIONS)

slow: $(VENV)/.dev
	@$(FETCH_FACES)
	$(BIN)/python -m pytest -n logical --dist loadfile -m slow $(OPTIONS)

fuzz: $(VENV)/.dev
	HYPOTHESIS_PROFILE=random $(BIN)/python -m pytest -n logical --dist worksteal -m hypothesis $(OPTIONS)

check: $(VENV)/.dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python .ci/circles.py
	$(BIN)/codespell hri apps benchmarks tests docs config *.md
	$(BIN)/python .ci/prose.py

# Of `hri bench`, all that takes something from benchmarks/.
COMPARED := behavior drive emotion face inputs people speech vision writes

bench: $(VENV)/.dev
	@$(FETCH_FACES)
	@$(if $(OPTIONS),$(BIN)/hri bench $(OPTIONS),for name in $(COMPARED); do $(BIN)/hri bench $$name || exit; done)

wheels: $(VENV)/.dev
	.ci/lock
	.ci/wheels

docs: $(VENV)/.dev
	$(BIN)/pdoc -o build/reference hri $(subst /,.,$(patsubst %/__init__.py,%,$(wildcard hri/*/__init__.py)))
	@echo "open build/reference/index.html"

checklist: $(VENV)/.dev
	$(BIN)/python -m pytest -n logical --dist loadfile -m "not slow" --checklist $(OPTIONS)

format: $(VENV)/.dev
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean:
	rm -rf build $(VENV) .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))' || \
	  { echo "hri needs Python 3.11 to 3.14, and $(PYTHON) is none of them - try: make run PYTHON=python3.13"; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
	  { echo "this Python has no venv: apt install python3-venv"; exit 1; }
	@echo "setting up $(VENV) (once) ..."
	@$(PYTHON) -m venv $(VENV)

# Each package has one of the locked hashes. Only srt and `hri` itself run something of theirs when
# they are installed; both are built with what is locked, too.
PIP    := $(BIN)/python -m pip install --disable-pip-version-check --progress-bar on --no-deps --no-build-isolation
LOCKED := $(PIP) --require-hashes --only-binary :all: --no-binary srt --use-pep517 --requirement
# Lines about packages that only other systems need are left out.
APPLIES := | awk '!/^Ignoring / { print; fflush() }'

$(VENV)/.run: pyproject.toml .ci/requirements/build.txt .ci/requirements/run.txt | $(BIN)/python
	@$(TELL_SOURCE)
	@$(LOCKED) .ci/requirements/build.txt $(APPLIES)
	@$(LOCKED) .ci/requirements/run.txt $(APPLIES)
	@$(PIP) --editable .
	@touch $@

$(VENV)/.dev: pyproject.toml .ci/requirements/build.txt .ci/requirements/dev.txt | $(BIN)/python
	@$(TELL_SOURCE)
	@$(LOCKED) .ci/requirements/build.txt $(APPLIES)
	@$(LOCKED) .ci/requirements/dev.txt $(APPLIES)
	@$(PIP) --editable .
	@touch $@ $(VENV)/.run
