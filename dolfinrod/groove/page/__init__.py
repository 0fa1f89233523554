"""What the runs of a folder show, as pages, pictures and files; Matplotlib and Plotly are loaded when it is called."""

from dolfinrod.groove.page.door import report

__all__ = ["report"]
