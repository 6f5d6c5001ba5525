"""Built-in methods; a new one is added to the tuple."""

from estimator.baseline import BASELINE
from estimator.method import register
from estimator.paper import ALGORITHM_1

BUILT_IN = (ALGORITHM_1, BASELINE)

for _method in BUILT_IN:
    register(_method)
