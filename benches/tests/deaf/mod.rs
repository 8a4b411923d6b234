//! A library that does nothing of what it is asked, without a word.

use dsr_benches::error::Result;
use dsr_benches::scene::{Content, Link, Plan, Reconciles, Scene, Tree};

pub(crate) struct Deaf;

impl Scene for Deaf {
    const NAME: &'static str = "deaf";
    const MAPPING: &'static str = "";

    fn empty(_: u16) -> Result<Self> {
        Ok(Self)
    }

    fn populate(&mut self, _: &Plan) -> Result<()> {
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }

    fn load(_: u16, _: &[u8]) -> Result<Self> {
        Ok(Self)
    }

    fn again(&mut self) -> Result<Self> {
        Ok(Self)
    }

    fn find(&mut self, _: &Plan) -> Result<()> {
        Ok(())
    }

    fn count(&self) -> Result<usize> {
        Ok(0)
    }

    fn set(&mut self, _: usize, _: &Content) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }

    fn set_unencoded(&mut self, _: usize, _: &Content) -> Result<()> {
        Ok(())
    }

    fn read(&self, _: usize) -> Result<Option<Content>> {
        Ok(None)
    }

    fn add_vertex(&mut self, _: &str, _: usize) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }

    fn remove_last_vertex(&mut self, _: &str) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }

    fn add_edge(&mut self, _: &Link) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }

    fn remove_edge(&mut self, _: &Link) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }

    fn has_edge(&self, _: &Link) -> Result<bool> {
        Ok(false)
    }

    fn apply(&mut self, _: &[u8]) -> Result<()> {
        Ok(())
    }

    type Whole = ();

    fn whole(&mut self) -> Result<()> {
        Ok(())
    }

    fn merge(&mut self, (): ()) -> Result<()> {
        Ok(())
    }
}

impl Reconciles for Deaf {
    fn digest(&mut self) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }

    fn missing(&mut self, _: &[u8]) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }
}

impl Tree for Deaf {
    fn move_below(&mut self, _: usize, _: usize) -> Result<Vec<u8>> {
        Ok(Vec::new())
    }

    fn move_unencoded(&mut self, _: usize, _: usize) -> Result<()> {
        Ok(())
    }

    fn depth(&self, _: usize) -> Result<usize> {
        Ok(0)
    }
}
