"""The paper's study: methods evaluated over recordings, reported as tables, figure and page."""
