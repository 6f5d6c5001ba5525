import threading

import pytest

from estimator import libraries


@pytest.mark.parametrize("load", [libraries.open3d, libraries.scikit_learn_hdbscan])
def test_libraries_are_imported_one_at_a_time(load):
    found = []
    thread = threading.Thread(target=lambda: found.append(load()))
    with libraries._importing:
        thread.start()
        thread.join(0.2)
        assert found == []
    thread.join(30)
    assert len(found) == 1
