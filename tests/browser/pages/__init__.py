"""What tests/browser/page.py looks at, by what it is about."""
