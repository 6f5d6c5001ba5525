"""The paper's study: recordings, methods and parameters in; tables, a figure and a page out."""
