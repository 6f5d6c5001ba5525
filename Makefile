# The commands of Tofscope. DEVELOPMENT.md describes them.

BIN := .venv/bin
STAMP := .venv/.set-up

.PHONY: run test fuzz bench bench-compare setup samples

# Open the app; ARGS goes to `tofscope view`, as in: make run ARGS="my_recording.mcap --port 9000"
run: setup
	@$(BIN)/tofscope view $(ARGS)

# Lint, format, types, tests. Bytecode is kept, since many tests start the command anew.
test: setup
	@command -v chromium > /dev/null || \
		tools/install_system_packages.sh "The tests of the app drive a browser" chromium
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/pyright
	PYTHONDONTWRITEBYTECODE= OMP_NUM_THREADS=1 $(BIN)/pytest -n 2 --no-loadscope-reorder

# Try thousands of damaged recordings; ARGS as in: make fuzz ARGS="--count 500 --seed 3"
fuzz: setup
	OMP_NUM_THREADS=1 $(BIN)/python -m tests.fuzz $(ARGS)

# Measure everything beside the naive pipeline; the table is kept in benchmarks/results.
bench: setup
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.bench

# Compare the last commit's table with the last run's; or make bench-compare ARGS="a.json b.json"
bench-compare: setup
	@$(BIN)/python -m benchmarks.compare $(ARGS)

# Everything that run and test need; skipped while nothing has changed.
setup: $(STAMP)

$(STAMP): pyproject.toml constraints.txt tools/setup.sh
	@tools/setup.sh
	@touch $@

# Make the shipped recordings again.
samples: setup
	$(BIN)/tofscope simulate all --speed 0.25 --trial 1 --out recordings/samples
